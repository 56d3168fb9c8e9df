// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/range_overview.h"

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
/// A whole second: shorter parts show the beat of samples and buckets, not the rate.
constexpr std::int64_t kLeastPartNs = kSecondNs;

} // namespace

void RangeOverview::refresh() {
    const std::int64_t end = m_view.cursorStampNs();
    if (m_view.streams().empty() || m_view.firstStampNs() == 0 || end <= m_view.firstStampNs()) {
        return;
    }
    const bool isSameSecond = end / kSecondNs == m_span.toNs / kSecondNs;
    m_span = {m_view.firstStampNs(), end};
    if (isSameSecond && !empty()) {
        return;
    }
    m_resolutionNs = 1;
    for (const model::Stream& stream : m_view.streams()) {
        m_resolutionNs = std::max(m_resolutionNs, stream.accounting.resolutionNs());
    }
    m_parts = model::partsOf(m_span, kMostParts, kLeastPartNs, m_resolutionNs);
    m_counted.assign(m_parts.count, {});
    for (const model::Stream& stream : m_view.streams()) {
        model::addParts(stream.accounting, m_parts, m_counted);
    }
}

} // namespace posewire::gui
