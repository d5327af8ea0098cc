// Simplifies a textured model and bakes a new texture.

#include <exception>
#include <fstream>
#include <iostream>

#include <faqem/report_json.hpp>
#include "faqem/bake.hpp"

int main(int argc, char** argv) try {
    if (argc != 4) {
        std::cerr << "usage: textured IN OUT REPORT.json\n";
        return 2;
    }
    const faqem::Asset source = faqem::load(argv[1]);
    for (const std::string& warning : source.warnings) std::cerr << argv[1] << ": " << warning << "\n";

    faqem::Options options;
    options.target = faqem::ratio(0.1);
    options.bake.texture_size = 512;
    options.bake.image_format = faqem::ImageFormat::jpeg;
    options.progress = [last = -1](faqem::Phase, double share) mutable {
        const int percent = static_cast<int>(100 * share);
        if (percent / 25 != last / 25) std::cerr << percent << "%\n";
        last = percent;
        return faqem::Continue::yes;  // Continue::cancel ends the run with StopReason::cancelled
    };

    const faqem::SimplifiedAsset simplified = faqem::simplify(source, options);
    std::ofstream(argv[3]) << faqem::to_json(simplified.report) << "\n";
    if (simplified.report.stop == faqem::StopReason::cancelled) return 1;
    for (const std::string& loss : faqem::save(simplified.asset, argv[2], faqem::Overwrite::yes))
        std::cerr << argv[2] << ": " << loss << "\n";
    std::cout << simplified.report.faces_in << " faces, now " << simplified.report.faces_out << ", with "
              << simplified.asset.images.size() << " images\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << "textured: " << error.what() << "\n";
    return 1;
}
