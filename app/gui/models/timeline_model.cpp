// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/timeline_model.h"

#include "app/gui/models/character_model.h"
#include "app/gui/models/text.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <map>

namespace posewire::gui {

void TimelineModel::refresh(const model::TimeRange& window, std::size_t most) {
    log::Duration resolution(1);
    for (const model::Stream& stream : m_view.roster().streams()) {
        resolution = std::max(resolution, stream.accounting.resolution(window.from));
    }
    constexpr std::int64_t kLeastBuckets = 2; // per part, or its edges would show
    m_settled.emplace(m_view, window);
    const log::Duration width = (window.to - window.from) / static_cast<std::int64_t>(most);
    m_isFine =
        width < kLeastBuckets * resolution && m_settled->isWhole() && datagramsIn(window) <= kMostArrivals;
    m_parts = m_isFine ? model::RangeParts{window.from, std::max(log::Duration(1), width), most}
                       : model::partsOf(window, most, kLeastBuckets * resolution, resolution);
    m_losses.emplace(m_view, std::nullopt);
    m_rows.clear();
    for (const model::CharacterKey& key : boardOf(m_view, BoardOrder::Appearance)) {
        addRows(key);
    }
}

/// To the accounting's buckets.
std::uint64_t TimelineModel::datagramsIn(const model::TimeRange& window) const {
    std::uint64_t datagrams = 0;
    for (const model::Stream& stream : m_view.roster().streams()) {
        datagrams += stream.accounting.countsBetween(window.from, window.to).datagrams;
    }
    return datagrams;
}

void TimelineModel::addRows(const model::CharacterKey& key) {
    Row whole{key, std::nullopt, nameApart(m_view, key), characterMark(m_view, key), {}, m_open.contains(key),
              {}};
    std::map<std::uint8_t, std::vector<log::StreamKey>> byType;
    for (const model::Character* one : m_view.roster().lineage(key)) {
        for (const model::Stream* stream : one->streams) {
            whole.streams.push_back(stream->key);
            byType[stream->key.type].push_back(stream->key);
        }
    }
    m_rows.push_back(whole);
    if (!whole.isOpen) {
        return;
    }
    for (auto& [type, streams] : byType) {
        m_rows.push_back({key, type, typeTitle(type), whole.mark, std::move(streams), false, {}});
    }
}

const TimelineModel::Row& TimelineModel::shown(std::size_t row) {
    Row& read = m_rows[row];
    if (!read.parts.empty() || m_parts.count == 0) {
        return read;
    }
    read.parts.resize(m_parts.count);
    for (const log::StreamKey& key : read.streams) {
        if (m_isFine) {
            m_view.messages().addArrivals(key, m_parts, 2 * kMostArrivals, read.parts); // edges of buckets
            m_settled->addParts(key, m_parts, read.parts);
        } else if (const model::Stream* stream = m_view.roster().find(key)) {
            m_losses->addParts(*stream, m_parts, read.parts);
        }
    }
    return read;
}

void TimelineModel::toggle(const model::CharacterKey& key) {
    if (m_open.erase(key) == 0) {
        m_open.insert(key);
    }
}

std::size_t TimelineModel::spacingOf(const std::vector<model::RangePart>& parts) {
    constexpr std::size_t kLeast = 4;
    std::vector<std::size_t> spacings;
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].datagrams != 0) {
            if (last) {
                spacings.push_back(i - *last);
            }
            last = i;
        }
    }
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::ranges::nth_element(spacings, middle);
    return spacings.size() < kLeast ? 0 : *middle;
}

std::vector<TimelineModel::Gap> TimelineModel::gapsIn(const std::vector<model::RangePart>& parts) {
    constexpr std::size_t kSpacings = 3;
    const std::size_t spacing = spacingOf(parts);
    std::vector<Gap> gaps;
    std::optional<std::size_t> last;
    for (std::size_t i = 0; spacing != 0 && i < parts.size(); ++i) {
        if (parts[i].datagrams == 0) {
            continue;
        }
        if (last && i - *last > kSpacings * spacing) {
            gaps.emplace_back(*last + spacing, i);
        }
        last = i;
    }
    return gaps;
}

} // namespace posewire::gui
