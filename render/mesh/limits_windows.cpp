// SPDX-License-Identifier: MIT
#include "render/mesh/confinement.h"

#include <windows.h>

namespace posewire::render {

void limitThisProcess(const char* /*outOfTime*/) {
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags =
        JOB_OBJECT_LIMIT_ACTIVE_PROCESS | JOB_OBJECT_LIMIT_PROCESS_MEMORY | JOB_OBJECT_LIMIT_PROCESS_TIME |
        JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
    limits.BasicLimitInformation.ActiveProcessLimit = 1;
    limits.BasicLimitInformation.PerProcessUserTimeLimit.QuadPart = 100'000'000; // 10 s, in units of 100 ns
    limits.ProcessMemoryLimit = SIZE_T{1} << 30;
    const HANDLE job = CreateJobObjectW(nullptr, nullptr); // for as long as the process is there
    if (job != nullptr &&
        SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits) != 0) {
        static_cast<void>(AssignProcessToJobObject(job, GetCurrentProcess()));
    }
}

} // namespace posewire::render
