#pragma once
/// \file
/// The images of a result, encoded with several sizes and qualities.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bake/scene/unencoded_result.hpp"
#include "cli/budget/budget_choices.hpp"
#include "cli/budget/search_steps.hpp"

namespace faqem::cli {

/// Total size of encoded images, bytes.
std::uint64_t encoded_bytes(const std::vector<Image>& images);

/// Tries images for a byte budget on all faces.
class ImageTrials {
public:
    /// \param full   all faces, with pending images unless those of the source are kept
    /// \param meter  of the source
    /// \param steps, meter  outlive this
    ImageTrials(detail::UnencodedResult full, const PictureMeter& meter, SearchSteps& steps);

    /// Tries images from the smallest to those that do not fit, and after that qualities around the best choice.
    /// \param geometry    tried geometry
    /// \param bytes       the budget
    /// \param begin, end  of the progress, shares of Phase::bake
    /// \throws engine::Cancelled
    /// Complexity: about ten encodings of each image for each size, on several threads.
    void try_all(std::span<const TriedFaces> faces, std::span<const TriedRounding> roundings,
                 std::uint64_t bytes, double begin, double end);

    const std::vector<TriedImages>& tried() const { return tried_; }

    /// Whether images are encoded again.
    bool are_encoded() const { return !sizes_.empty(); }

    /// All images, with those of a trial. \param trial  index into tried() \throws engine::Cancelled
    std::vector<Image> encoded(std::size_t trial, detail::ImageEffort effort);

private:
    void make_sizes();
    void try_qualities(std::size_t size, std::span<const std::optional<double>> qualities);
    std::vector<std::vector<Image>> encoded(std::size_t size,
                                            std::span<const std::optional<double>> qualities,
                                            detail::ImageEffort effort);

    detail::UnencodedResult full_;
    const PictureMeter& meter_;
    SearchSteps& steps_;
    std::vector<std::pair<std::uint32_t, std::vector<detail::PendingImage>>> sizes_;  // from large to small
    std::vector<TriedImages> tried_;
    std::vector<std::size_t> size_of_tried_;  // indices into sizes_, by tried images
};

}  // namespace faqem::cli
