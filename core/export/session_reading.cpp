// SPDX-License-Identifier: MIT
#include "core/export/session_reading.h"

#include "core/export/html.h"
#include "core/model/accounting/attribution.h"

#include <algorithm>

namespace posewire::exporting {

model::StreamFigures figuresOf(const model::SessionView& session, const model::Stream& stream,
                               const std::optional<model::TimeRange>& range) {
    using enum model::Figure;
    model::StreamFigures figures = model::figuresOf(stream, range);
    if (!range) {
        return figures;
    }
    constexpr std::array kCauses{LostHere, LostOnNetwork, LostAtSender};
    double unknown = figures[LostUnknown];
    for (const model::Gap& gap : session.gaps()) {
        if (gap.stream == stream.key && gap.toStamp >= range->from && gap.toStamp < range->to &&
            gap.cause != model::LossCause::Unknown) {
            const model::Figure cause = kCauses[static_cast<std::size_t>(gap.cause)];
            figures.set(cause, figures[cause] + gap.lost);
            unknown -= gap.lost;
        }
    }
    figures.set(LostUnknown, std::max(unknown, 0.0));
    return figures;
}

std::vector<const model::Stream*> streamsByType(const model::SessionView& session,
                                                const model::CharacterKey& key) {
    std::vector<const model::Stream*> streams;
    for (const model::Stream& stream : session.streams()) {
        if (stream.key.sender == key.sender && stream.key.character == key.character) {
            streams.push_back(&stream);
        }
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
    case model::FigureForm::Number:
    case model::FigureForm::Signed:
        break;
    }
    return fixed(figures.orZero(figure), decimals);
}

bool hasSentMxtp(const model::Sender& sender) {
    return sender.datagrams > sender.foreign || sender.skippedBytes != 0;
}

} // namespace posewire::exporting
