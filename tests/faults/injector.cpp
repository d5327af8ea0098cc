// Loaded with LD_PRELOAD: lets one of the calls that change or open files fail, or ends the process there.
//
//   FAQEM_FAULT_CALL   number of the call, from 1; 0 or unset: none
//   FAQEM_FAULT_KIND   "error": the call fails with EIO, write() after half of the bytes;
//                      "full": as error, with ENOSPC;
//                      "kill": SIGKILL before the call, write() after half of the bytes;
//                      "term": SIGTERM before the call
//   FAQEM_FAULT_FILE   instead of a call: opening a file of this name does what FAQEM_FAULT_KIND says: "segv": SIGSEGV,
//                      "kill": SIGKILL, "hang": the call does not return
//   FAQEM_FAULT_HANG   opening a file of this name does not return either
//   FAQEM_FAULT_LOG    file that receives the name of the call that was disturbed, and the number of calls
//                      when the process exits

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

long wanted_call, calls;
char kind;  // first letter of FAQEM_FAULT_KIND
const char *wanted_file, *hanging_file;

__attribute__((constructor)) void read_settings(void) {
    const char* number = getenv("FAQEM_FAULT_CALL");
    const char* name = getenv("FAQEM_FAULT_KIND");
    wanted_call = number ? atol(number) : 0;
    kind = name ? name[0] : 0;
    wanted_file = getenv("FAQEM_FAULT_FILE");
    hanging_file = getenv("FAQEM_FAULT_HANG");
}

void on_open(const char* path) {
    const char* slash = strrchr(path, '/');
    const char* name = slash ? slash + 1 : path;
    while (hanging_file && strcmp(name, hanging_file) == 0) pause();
    if (!wanted_file || strcmp(name, wanted_file) != 0) return;
    if (kind == 's') raise(SIGSEGV);
    if (kind == 'k') kill(getpid(), SIGKILL);
    while (kind == 'h') pause();
}

void log_text(const char* text) {
    const char* file = getenv("FAQEM_FAULT_LOG");
    if (!file) return;
    // Raw system calls, so that the log is neither counted nor disturbed.
    const long out = syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND, 0666);
    if (out < 0) return;
    syscall(SYS_write, out, text, strlen(text));
    syscall(SYS_close, out);
}

__attribute__((destructor)) void log_calls(void) {
    char text[32];
    snprintf(text, sizeof text, "calls %ld\n", calls);
    log_text(text);
}

/// Counts a call. Returns 1 if it must fail; errno is set then.
int is_disturbed(const char* name) {
    if (__atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST) != wanted_call || !kind) return 0;
    log_text(name);
    log_text("\n");
    if (kind == 'k') kill(getpid(), SIGKILL);
    if (kind == 't') raise(SIGTERM);
    errno = kind == 'f' ? ENOSPC : EIO;
    return kind == 'e' || kind == 'f';
}

}  // namespace

// The function that would be called without this library.
#define NEXT(name) (reinterpret_cast<decltype(&name)>(dlsym(RTLD_NEXT, #name)))
#define DISTURBED(name) \
    if (is_disturbed(#name)) return -1

// Replaces a function, of which all arguments are given.
#define REPLACE(name, signature, ...)   \
    int name signature {                \
        DISTURBED(name);                \
        return NEXT(name)(__VA_ARGS__); \
    }

// Replaces a function whose last argument, the mode, is given only if a file may be created.
#define REPLACE_OPEN(name, signature, ...)    \
    int name signature {                      \
        mode_t mode = 0;                      \
        if (flags & (O_CREAT | O_TMPFILE)) {  \
            va_list arguments;                \
            va_start(arguments, flags);       \
            mode = va_arg(arguments, mode_t); \
            va_end(arguments);                \
        }                                     \
        on_open(path);                        \
        DISTURBED(name);                      \
        return NEXT(name)(__VA_ARGS__, mode); \
    }

extern "C" {

REPLACE_OPEN(open, (const char* path, int flags, ...), path, flags)
REPLACE_OPEN(open64, (const char* path, int flags, ...), path, flags)
REPLACE_OPEN(openat, (int folder, const char* path, int flags, ...), folder, path, flags)
REPLACE_OPEN(openat64, (int folder, const char* path, int flags, ...), folder, path, flags)

ssize_t write(int file, const void* bytes, size_t size) {
    if (calls + 1 == wanted_call && kind != 't' && size > 1)
        if (NEXT(write)(file, bytes, size / 2) < 0) return -1;
    DISTURBED(write);
    return NEXT(write)(file, bytes, size);
}

REPLACE(fsync, (int file), file)
REPLACE(fdatasync, (int file), file)
REPLACE(link, (const char* from, const char* to) noexcept, from, to)
REPLACE(linkat, (int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept,
        from_folder, from, to_folder, to, flags)
REPLACE(rename, (const char* from, const char* to) noexcept, from, to)
REPLACE(renameat, (int from_folder, const char* from, int to_folder, const char* to) noexcept, from_folder,
        from, to_folder, to)
REPLACE(renameat2,
        (int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept,
        from_folder, from, to_folder, to, flags)
REPLACE(unlink, (const char* path) noexcept, path)
REPLACE(unlinkat, (int folder, const char* path, int flags) noexcept, folder, path, flags)
REPLACE(mkdirat, (int folder, const char* path, mode_t mode) noexcept, folder, path, mode)
REPLACE(fchmod, (int file, mode_t mode) noexcept, file, mode)
REPLACE(flock, (int file, int operation) noexcept, file, operation)

}  // extern "C"
