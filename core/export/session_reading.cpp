// SPDX-License-Identifier: MIT
#include "core/export/session_reading.h"

#include "core/export/html.h"
#include "core/model/accounting/attribution.h"

#include <algorithm>

namespace posewire::exporting {

std::array<std::uint64_t, model::kLossCauses> lostByCause(const model::SessionView& session,
                                                          const model::Stream& stream,
                                                          const std::optional<model::TimeRange>& range) {
    if (!range) {
        return stream.lostByCause();
    }
    const model::StreamCounts counts = stream.accounting.countsBetween(range->from, range->to);
    std::array<std::uint64_t, model::kLossCauses> lost{};
    std::uint64_t unknown = counts.lost + counts.incomplete;
    for (const model::Gap& gap : session.gaps()) {
        if (gap.stream == stream.key && gap.toStamp >= range->from && gap.toStamp < range->to &&
            gap.cause != model::LossCause::Unknown) {
            lost[static_cast<std::size_t>(gap.cause)] += gap.lost;
            unknown -= std::min<std::uint64_t>(gap.lost, unknown);
        }
    }
    lost[static_cast<std::size_t>(model::LossCause::Unknown)] = unknown;
    return lost;
}

model::StreamFigures figuresOf(const model::SessionView& session, const model::Stream& stream,
                               const std::optional<model::TimeRange>& range) {
    using enum model::Figure;
    model::StreamFigures figures = model::figuresOf(stream, range);
    constexpr std::array kCauses{LostHere, LostOnNetwork, LostAtSender, LostUnknown};
    const auto lost = lostByCause(session, stream, range);
    for (std::size_t cause = 0; cause < kCauses.size(); ++cause) {
        figures.set(kCauses[cause], static_cast<double>(lost[cause]));
    }
    return figures;
}

std::vector<const model::Stream*> streamsByType(const model::SessionView& session,
                                                const model::CharacterKey& key) {
    const model::Character* character = session.find(key);
    std::vector<const model::Stream*> streams;
    if (character != nullptr) {
        streams = character->streams;
    }
    std::ranges::sort(streams, {}, [](const model::Stream* stream) { return stream->key.type; });
    return streams;
}

std::string figureText(const model::StreamFigures& figures, model::Figure figure, int decimals) {
    switch (model::rowOf(figure).style.form) {
    case model::FigureForm::Count:
        return grouped(figures.count(figure));
    case model::FigureForm::Counter:
        return std::to_string(figures.count(figure));
    case model::FigureForm::Share:
        return fixed(100 * figures.orZero(figure), decimals);
    default:
        return fixed(figures.orZero(figure), decimals);
    }
}

bool hasSentMxtp(const model::Sender& sender) {
    return sender.datagrams > sender.foreign || sender.skippedBytes != 0;
}

} // namespace posewire::exporting
