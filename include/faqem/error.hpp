#pragma once
/// \file
/// Exceptions. Cancellation and a missed target are not errors: they are reported as StopReason.

#include <stdexcept>
#include <string>

#include "faqem/export.hpp"

namespace faqem {

/// Base class of all exceptions that faqem defines. Exceptions of the standard library, such as
/// std::bad_alloc, and those of the progress callback may be thrown as well.
class FAQEM_EXCEPTION Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An option is out of range or contradicts another one. Exit code 2 of the command.
class FAQEM_EXCEPTION OptionError : public Error {
public:
    using Error::Error;
};

/// The input data is invalid. The message has the form `file: element: what`. Exit code 3 of the command.
class FAQEM_EXCEPTION InputError : public Error {
public:
    using Error::Error;

    /// \param file     path as passed by the caller; empty for data in memory
    /// \param element  invalid element, e.g. `/accessors/3` or `line 17`; may be empty
    /// \param what     description of the error
    InputError(const std::string& file, const std::string& element, const std::string& what)
        : Error((file.empty() ? "" : file + ": ") + (element.empty() ? "" : element + ": ") + what) {}
};

/// The input is valid, but of a kind that this build does not support (e.g. KTX2 images). Exit code 4 of the
/// command.
class FAQEM_EXCEPTION UnsupportedError : public InputError {
public:
    using InputError::InputError;
};

/// A file could not be read. Exit code 3 of the command.
class FAQEM_EXCEPTION ReadError : public InputError {
public:
    using InputError::InputError;
};

/// Options::max_seconds was over before there was a result that the options allow. Exit code 12 of the command.
class FAQEM_EXCEPTION TimeLimitError : public Error {
public:
    using Error::Error;
};

/// No result has at most Options::max_bytes. Exit code 10 of the command.
class FAQEM_EXCEPTION ByteLimitError : public Error {
public:
    using Error::Error;
};

/// A file could not be written. An existing file with the same name is unchanged. Exit code 7 of the command.
class FAQEM_EXCEPTION WriteError : public Error {
public:
    using Error::Error;
};

}  // namespace faqem
