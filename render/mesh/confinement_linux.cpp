// SPDX-License-Identifier: MIT
#include "render/mesh/confinement.h"

#include <cstddef>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

// System calls without wrappers in the C library are made by number.
namespace posewire::render {
namespace {

/// The version of Landlock that holds now; 0 if the kernel has none.
long confineFiles(const std::string& folder) {
    const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    landlock_ruleset_attr everything{};
    everything.handled_access_fs = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1; // all that version 1 knows
    const auto rules =
        static_cast<int>(::syscall(SYS_landlock_create_ruleset, &everything, sizeof everything, 0));
    landlock_path_beneath_attr below{};
    below.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
    below.parent_fd = ::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    const bool holds = version > 0 && rules >= 0 && below.parent_fd >= 0 &&
                       ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &below, 0) == 0 &&
                       ::syscall(SYS_landlock_restrict_self, rules, 0) == 0;
    ::close(below.parent_fd);
    ::close(rules);
    return holds ? version : 0;
}

#if defined(__x86_64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned kArchitecture = 0;
#endif

/// All that reading, computing, writing to a pipe and ending take.
constexpr long kAllowed[] = {
    SYS_read,         SYS_pread64,         SYS_readv,          SYS_write,         SYS_writev,
    SYS_close,        SYS_lseek,           SYS_fstat,          SYS_newfstatat,    SYS_statx,
    SYS_readlinkat,   SYS_getcwd,          SYS_fcntl,          SYS_mmap,          SYS_munmap,
    SYS_mprotect,     SYS_mremap,          SYS_madvise,        SYS_brk,           SYS_futex,
    SYS_rt_sigreturn, SYS_rt_sigaction,    SYS_rt_sigprocmask, SYS_sigaltstack,   SYS_getpid,
    SYS_gettid,       SYS_tgkill,          SYS_getrandom,      SYS_clock_gettime, SYS_gettimeofday,
    SYS_sched_yield,  SYS_restart_syscall, SYS_exit,           SYS_exit_group,
#if defined(__x86_64__)
    SYS_stat,         SYS_lstat,           SYS_readlink,
#endif
};

/// Everything else fails with EPERM: sockets, processes, signals to others, files opened to be written.
bool confineSystemCalls() {
    const auto load = [](std::size_t offset) {
        return sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset));
    };
    constexpr sock_filter kAllow BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    constexpr sock_filter kRefuse BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | 1 /* EPERM */);
    std::vector<sock_filter> program{load(offsetof(seccomp_data, arch)),
                                     BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0), kRefuse,
                                     load(offsetof(seccomp_data, nr))};
    for (const long allowed : kAllowed) {
        program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(allowed), 0, 1));
        program.push_back(kAllow);
    }
    program.insert(program.end(),
                   {BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 1, 0), kRefuse,
                    load(offsetof(seccomp_data, args) + 2 * sizeof(__u64)), // flags, the low half
                    BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, O_ACCMODE | O_CREAT | O_TRUNC, 0, 1), kRefuse,
                    kAllow});
    const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
    return kArchitecture != 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

} // namespace

std::string confineTo(const std::string& folder) {
    static_cast<void>(::syscall(SYS_close_range, 3U, ~0U, 0U)); // what the window had open
    ::prctl(PR_SET_DUMPABLE, 0);
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    const long landlock = confineFiles(folder);
    const bool hasSeccomp = confineSystemCalls();
    const std::string files = landlock > 0 ? "Landlock " + std::to_string(landlock) : "no Landlock";
    return files + (hasSeccomp ? ", seccomp" : ", no seccomp");
}

} // namespace posewire::render
