/// \file
/// Passes the progress of a run from WebAssembly to a callback in JavaScript.

#include "faqem/faqem.h"

extern "C" {

/// A function of faqem.js, with the meaning of faqem_progress.
int faqem_web_progress(faqem_phase phase, double fraction);

/// Lets a run report its progress to JavaScript.
void faqem_web_watch(faqem_options* options) {
    faqem_options_set_progress(
        options,
        [](void*, faqem_phase phase, double fraction) { return faqem_web_progress(phase, fraction); },
        nullptr);
}
}
