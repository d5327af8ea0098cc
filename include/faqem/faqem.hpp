#pragma once
/// \file
/// All doors that need nothing but the standard library. faqem/openmesh.hpp is apart: it needs OpenMesh.

#include "faqem/asset.hpp"
#include "faqem/bake.hpp"
#include "faqem/bake_levels.hpp"
#include "faqem/compare.hpp"
#include "faqem/compare_colors.hpp"
#include "faqem/cut.hpp"
#include "faqem/error.hpp"
#include "faqem/forward_map.hpp"
#include "faqem/history.hpp"
#include "faqem/levels.hpp"
#include "faqem/mesh.hpp"
#include "faqem/options.hpp"
#include "faqem/progress.hpp"
#include "faqem/report.hpp"
#include "faqem/save_levels.hpp"
#include "faqem/simplify.hpp"
#include "faqem/surface_map.hpp"
#include "faqem/version.hpp"
