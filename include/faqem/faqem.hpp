#pragma once
/// \file
/// All public headers that need only the standard library. Not included: faqem/openmesh.hpp, which
/// needs OpenMesh. In header-only mode the headers for textured assets and report_json.hpp are omitted,
/// because they need compiled libraries or nlohmann-json.

#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "faqem/forward_map.hpp"
#include "faqem/history.hpp"
#include "faqem/levels.hpp"
#include "faqem/mesh.hpp"
#include "faqem/options.hpp"
#include "faqem/progress.hpp"
#include "faqem/report.hpp"
#include "faqem/simplify.hpp"
#include "faqem/surface_map.hpp"
#include "faqem/truncate.hpp"
#include "faqem/version.hpp"

#ifndef FAQEM_HEADER_ONLY
#include "faqem/asset.hpp"
#include "faqem/bake.hpp"
#include "faqem/bake_levels.hpp"
#include "faqem/bake_onto.hpp"
#include "faqem/compare_colors.hpp"
#include "faqem/report_json.hpp"
#include "faqem/save_levels.hpp"
#endif
