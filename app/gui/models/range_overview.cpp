// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/range_overview.h"

#include <algorithm>

namespace posewire::gui {

namespace {

/// A whole second: shorter parts show the beat of samples and buckets, not the rate.
constexpr log::Duration kLeastPart = std::chrono::seconds(1);

} // namespace

void RangeOverview::refresh() {
    const log::Stamp end = m_view.cursorStamp();
    if (m_view.streams().empty() || m_view.firstStamp() == log::Stamp() || end <= m_view.firstStamp()) {
        return;
    }
    using std::chrono::seconds;
    using std::chrono::time_point_cast;
    const bool isSameSecond = time_point_cast<seconds>(end) == time_point_cast<seconds>(m_span.to);
    m_span = {m_view.firstStamp(), end};
    if (isSameSecond && !empty()) {
        return;
    }
    m_resolution = log::Duration(1);
    for (const model::Stream& stream : m_view.streams()) {
        m_resolution = std::max(m_resolution, stream.accounting.resolution());
    }
    m_parts = model::partsOf(m_span, kMostParts, kLeastPart, m_resolution);
    m_counted.assign(m_parts.count, {});
    for (const model::Stream& stream : m_view.streams()) {
        model::addParts(stream.accounting, m_parts, m_counted);
    }
}

} // namespace posewire::gui
