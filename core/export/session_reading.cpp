// SPDX-License-Identifier: MIT
#include "core/export/session_reading.h"

#include "core/export/html.h"
#include "core/model/session/roster.h"

#include <algorithm>

namespace posewire::exporting {

std::vector<const model::Stream*> streamsByType(const model::SessionView& session,
                                                const model::CharacterKey& key) {
    const model::Character* character = session.roster().find(key);
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
