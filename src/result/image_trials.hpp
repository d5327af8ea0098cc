#pragma once
/// \file
/// The images of a result, each encoded in several sizes and ways, and those that fit a number of bytes.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bake/scene/unencoded_result.hpp"
#include "bake/texture/pending_images.hpp"
#include "faqem/asset.hpp"
#include "faqem/options.hpp"
#include "result/result_choices.hpp"

namespace faqem::detail {

/// Total size of encoded images, bytes.
std::uint64_t encoded_bytes(const std::vector<Image>& images);

/// Tries images for a byte limit on all faces.
class ImageTrials {
public:
    /// \param full   all faces, with pending images unless those of the source are kept
    /// \param bake, context  outlive this
    ImageTrials(UnencodedResult full, const BakeOptions& bake, const RunContext& context);

    /// Tries each image in a small size with every fineness. Then it tries what is next to the choices that are
    /// best for the limit: larger images, and finer encodings.
    /// \param faces, roundings  tried geometry
    /// \param bytes             the limit
    /// \param begin, end        of the progress, shares of Phase::bake
    /// \throws engine::Cancelled
    /// Complexity: about ten encodings of each image, on several threads, and pictures for each size.
    void try_all(std::span<const TriedFaces> faces, std::span<const TriedRounding> roundings,
                 std::uint64_t bytes, double begin, double end);

    /// By pending image; empty if none is encoded.
    const TriedImages& tried() const { return tried_; }

    /// Whether images are encoded again.
    bool are_encoded() const { return !sizes_.empty(); }

    /// Bytes of the images that stay as they are.
    std::uint64_t passed_bytes() const { return encoded_bytes(full_.asset.asset.images); }

    /// All images of the result, with the encodings of a choice. \param chosen  ResultChoice::images
    std::vector<Image> chosen_images(const std::vector<std::size_t>& chosen) const;

private:
    /// What an encoding with a difference adds to the error of pictures.
    struct Sample {
        double difference = 0;
        PictureDifference added;
    };
    /// Errors of pictures for the size alone, and for encodings: in ascending order of differences.
    struct SizeError {
        PictureDifference own;
        std::vector<Sample> samples;
    };
    /// An image in one size.
    struct Size {
        PendingImage pending;
        std::vector<ImageEncoding> encodings;       // by ascending fineness
        std::vector<std::uint8_t> is_tried;         // by encoding
        std::optional<std::uint32_t> finest_tried;  // fineness
        std::optional<SizeError> error;             // if an encoding was tried
    };
    /// What an entry of tried_ is.
    struct Trial {
        std::size_t size = 0;
        std::uint32_t fineness = 0;
        double difference = 0;  // mean_square_error()
        Image image;
    };
    /// Encodings of an image in one size that are to be tried: with a fineness from `first` to `last` in steps.
    struct Request {
        std::size_t image = 0, size = 0;
        std::uint32_t first = 0, last = 0, step = fineness_step;
    };

    void make_sizes();
    void encode(std::span<const Request> requests);
    void measure_sizes(std::span<const Request> requests);
    void measure_choice(const ResultChoice& choice);
    static void add_sample(SizeError& error, const PictureDifference& both, double difference);
    static PictureDifference estimated_error(const SizeError& error, double difference);
    void update_errors();
    std::vector<Request> smaller_requests() const;
    std::vector<Request> next_requests(const ResultChoice& choice) const;
    std::vector<Request> refining_requests(const ResultChoice& choice, std::uint32_t distance,
                                           std::uint64_t least_bytes) const;
    PictureDifference unseen_error(double error) const;

    UnencodedResult full_;
    const BakeOptions& bake_;
    const RunContext& context_;
    std::optional<ImageErrorMeter> meter_;
    std::vector<std::vector<Size>> sizes_;  // by pending image, from small to large
    std::vector<std::vector<Trial>> trials_;
    TriedImages tried_;
    // Sum over the sizes of images that pictures show: their errors for those of texels, where they are shown.
    double seen_gain_ = 0;
    int seen_sizes_ = 0;
};

/// Size of the files of a model, bytes.
struct ModelSize {
    std::uint64_t geometry = 0;  ///< other than images
    std::uint64_t images = 0;    ///< encoded images
    std::uint64_t fixed = 0;     ///< of the geometry: animations, whose size does not depend on the faces

    std::uint64_t total() const { return geometry + images; }
};

/// Returns the size of the files that save() would write. Files beside a model are named after it, and it refers to them
/// by these names: they are counted for a name with 64 characters, so that results do not depend on the name.
/// \param format  not ModelFormat::automatic
/// \throws WriteError  the format cannot hold the asset
/// Complexity: that of save() without writing.
ModelSize model_size(const Asset& asset, ModelFormat format);

/// Gives the pending images of a result the sizes and encodings that give the best pictures for the bytes. Faces,
/// positions and UVs stay.
/// \param result   has pending images; afterwards these are encoded, and none is pending
/// \param options  resolved; BakeOptions::image_quality is ignored
/// \param bytes    of all files
/// \return the size of the result. It is above `bytes` if even the smallest images do not fit; the result has these
/// \throws TimeLimitError  Options::max_seconds was over before images were chosen
/// \throws engine::Cancelled
/// Complexity: about ten encodings of each image, and renderings of six views.
ModelSize fit_images(UnencodedResult& result, const Options& options, const RunContext& context,
                     std::uint64_t bytes);

}  // namespace faqem::detail
