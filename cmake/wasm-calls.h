/* Calls that LLVM's C++ library makes for files, and the C library of WASI has only since 2023: here they fail, for a module has no files. */
#pragma once

#include <dirent.h>
#include <errno.h>
#include <sys/stat.h>

#define DT_SOCK 12

struct statvfs {
    unsigned long f_frsize;
    unsigned long long f_blocks, f_bfree, f_bavail;
};

static inline int no_such_call(void) {
    errno = ENOSYS;
    return -1;
}
static inline int statvfs(const char *path, struct statvfs *found) { return no_such_call(); }
static inline int fchmod(int file, mode_t mode) { return no_such_call(); }
static inline int fchmodat(int folder, const char *path, mode_t mode, int flags) { return no_such_call(); }
static inline char *realpath(const char *path, char *found) {
    no_such_call();
    return 0;
}
