#pragma once
/// \file
/// What is seen from outside of a shared library.

/// Marks a function or class that other libraries may call: everything else of a shared library is hidden. It
/// goes before a function's declaration, and between `class` and its name.
#define FAQEM_EXPORT [[gnu::visibility("default")]]
