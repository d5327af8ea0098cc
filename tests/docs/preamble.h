/* Declarations of the reader's data that code blocks use. */
#include <faqem/faqem_asset.h>
#include <faqem/faqem_levels.h>

static faqem_options* options;
static faqem_error error;
static faqem_mesh mesh;
static faqem_asset* source;
static faqem_asset* chain[2];
