#pragma once
/// \file
/// The exceptions faqem throws. Stopping early is not one of them: that is a StopReason in the report.

#include <stdexcept>
#include <string>

#include "faqem/export.hpp"

namespace faqem {

/// Base of everything faqem throws.
class FAQEM_EXCEPTION Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An option is out of range or contradicts another. The tool exits with 2.
class FAQEM_EXCEPTION OptionError : public Error {
public:
    using Error::Error;
};

/// The input data is wrong. The message reads `file: element: what`. The tool exits with 3.
class FAQEM_EXCEPTION InputError : public Error {
public:
    using Error::Error;

    /// \param file     path as the user gave it; empty for data in memory
    /// \param element  what in the file is wrong, e.g. `/accessors/3` or `line 17`; may be empty
    /// \param what     why it is wrong
    InputError(const std::string& file, const std::string& element, const std::string& what)
        : Error((file.empty() ? "" : file + ": ") + (element.empty() ? "" : element + ": ") + what) {}
};

/// The input is valid, but of a kind this build cannot handle (Draco, KTX2 ...). The tool exits with 4.
class FAQEM_EXCEPTION UnsupportedError : public InputError {
public:
    using InputError::InputError;
};

/// A file could not be read. The tool exits with 3.
class FAQEM_EXCEPTION ReadError : public InputError {
public:
    using InputError::InputError;
};

/// A file could not be written. The old file, if any, is untouched. The tool exits with 7.
class FAQEM_EXCEPTION WriteError : public Error {
public:
    using Error::Error;
};

}  // namespace faqem
