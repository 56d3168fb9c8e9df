// SPDX-License-Identifier: MIT
#include "render/mesh/confinement.h"

#include <csignal>
#include <cstring>

#include <sys/resource.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define POSEWIRE_IS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define POSEWIRE_IS_SANITIZED
#endif
#endif

namespace posewire::render {
namespace {

constexpr rlim_t kMostMemory = rlim_t{1} << 30;
constexpr rlim_t kMostProcessorSeconds = 10;
constexpr unsigned kMostSeconds = 30;

const char* g_outOfTime;

void endOutOfTime(int /*signal*/) {
    ::_exit(::write(STDOUT_FILENO, g_outOfTime, std::strlen(g_outOfTime)) < 0 ? 3 : 2);
}

} // namespace

void limitThisProcess(const char* outOfTime) {
    g_outOfTime = outOfTime;
    std::signal(SIGXCPU, endOutOfTime);
    std::signal(SIGALRM, endOutOfTime);
    ::alarm(kMostSeconds);
    const auto limit = [](auto resource, rlim_t soft, rlim_t hard) {
        const rlimit bounds{soft, hard};
        static_cast<void>(::setrlimit(resource, &bounds));
    };
    limit(RLIMIT_CPU, kMostProcessorSeconds, kMostProcessorSeconds + 1);
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_FSIZE, 0, 0);
    limit(RLIMIT_NPROC, 0, 0);
#ifndef POSEWIRE_IS_SANITIZED // their shadow memory is larger
    limit(RLIMIT_AS, kMostMemory, kMostMemory);
#endif
}

} // namespace posewire::render
