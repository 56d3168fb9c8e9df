// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/outlets/metrics.h"

#include <prometheus/metric_family.h>

#include <cstddef>
#include <string_view>
#include <vector>

namespace posewire::outlets {

/// Labels name at most this many characters and streams; sums are of all of them.
inline constexpr std::size_t kMostCharacters = 64;
inline constexpr std::size_t kMostStreams = 1024;

/// Every figure that is served, in seconds, bytes and ratios. Labels name only the characters that the
/// session lists now. What the session may still revise (a sample that counts as lost may come late) is a
/// gauge; counters never decrease. packaging/formats.md lists them.
[[nodiscard]] std::vector<prometheus::MetricFamily>
metricFamilies(const model::SessionView& session, const OwnFigures& own, std::string_view version);

} // namespace posewire::outlets
