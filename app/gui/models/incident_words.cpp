// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/incident_words.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"

namespace posewire::gui {

namespace {

using model::IncidentKind;

} // namespace

Health healthOf(model::IncidentSeverity severity) {
    constexpr std::array kHealths{Health::Good, Health::Warning, Health::Error}; // by IncidentSeverity
    return kHealths[static_cast<std::size_t>(severity)];
}

QString severityWord(model::IncidentSeverity severity) {
    const std::array words{tr("note"), tr("warning"), tr("error")}; // by IncidentSeverity
    return words[static_cast<std::size_t>(severity)];
}

QString groupWord(model::IncidentGroup group) {
    const std::array words{tr("Sender"), tr("Loss"), tr("Content"), tr("Limit")}; // by IncidentGroup
    return words[static_cast<std::size_t>(group)];
}

QString whoseWords(model::SessionView& view, const model::Incident& incident) {
    const std::vector<model::CharacterKey> characters = incident.characters();
    if (characters.empty()) {
        return shown(view.roster().addressOf(incident.sender));
    }
    const model::CharacterKey& first = characters.front();
    const QString count = tr("%n characters", nullptr, static_cast<int>(characters.size()));
    const bool isOfOneSender = characters.size() > 1 && incident.sender == first.sender;
    const QString sender = isOfOneSender ? senderApart(view, first) : QString();
    const QString name = characters.size() == 1 ? nameApart(view, first)
                         : sender.isEmpty()     ? count
                                                : count + QStringLiteral(" · ") + sender;
    const auto type = incident.type();
    return type ? name + QStringLiteral(" · ") + QString::fromStdString(wire::typeDigits(*type)) : name;
}

QString whoseWords(model::SessionView& view, const model::Incident::Part& part) {
    return part.character ? nameApart(view, *part.whose()) : shown(view.roster().addressOf(part.sender));
}

QString helpPlaceOf(const model::Incident& incident) {
    const bool isLoss = incident.kind == IncidentKind::Loss && incident.cause;
    const std::string_view heading = isLoss ? model::nameOf(*incident.cause) : model::nameOf(incident.kind);
    return QStringLiteral("causes#") + fromUtf8(heading).replace(u' ', u'-');
}

std::optional<std::uint64_t> incidentPacket(model::SessionView& view, const model::Incident& incident) {
    // Conditions that last are found by the clock: no packet is theirs.
    if (incident.kind == IncidentKind::Outage || incident.kind >= IncidentKind::LossLimit) {
        const std::uint64_t after = view.packetFrom(incident.firstStamp + log::Duration(1));
        return after == view.begin() ? std::nullopt : std::optional(after - 1);
    }
    return incident.lastPacket >= view.begin() && incident.lastPacket < view.end()
               ? std::optional(incident.lastPacket)
               : std::nullopt;
}

PacketsBehind packetsBehind(model::SessionView& view, const model::Incident& incident,
                            const model::Incident::Part* part) {
    const model::Incident own = part != nullptr ? incident.of(*part) : incident;
    PacketsBehind behind{packetFilterOf(view, own)};
    behind.type = own.type();
    behind.character = own.character() ? std::optional(own.character()->character) : std::nullopt;
    const bool isSilence =
        incident.kind == IncidentKind::Outage && (incident.isCurrent || incident.samples == 0);
    const bool isSettled = own.lastPacket != 0;
    if (isSilence || (isSettled && part == nullptr) || own.group() == model::IncidentGroup::Limit) {
        behind.packet = incidentPacket(view, own);
    }
    return behind;
}

} // namespace posewire::gui
