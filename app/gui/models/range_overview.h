// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/range_figures.h"
#include "core/model/session/session_view.h"

#include <vector>

namespace posewire::gui {

/// Datagrams and losses of all streams over the whole history, in parts of equal length; read anew once a
/// second.
class RangeOverview {
public:
    static constexpr std::size_t kMostParts = 240;

    explicit RangeOverview(model::SessionView& view) : m_view(view) {}

    void refresh();

    /// From the first packet to the cursor.
    [[nodiscard]] const model::TimeRange& span() const { return m_span; }
    [[nodiscard]] const model::RangeParts& parts() const { return m_parts; }
    [[nodiscard]] const std::vector<model::RangePart>& counted() const { return m_counted; }
    [[nodiscard]] bool empty() const { return m_parts.count == 0; }
    /// The coarsest of the streams: finer ranges make no difference.
    [[nodiscard]] log::Duration resolution() const { return m_resolution; }

private:
    model::SessionView& m_view;
    model::TimeRange m_span;
    model::RangeParts m_parts;
    std::vector<model::RangePart> m_counted;
    log::Duration m_resolution{1};
};

} // namespace posewire::gui
