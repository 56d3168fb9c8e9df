// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/captions.h"

#include "app/gui/models/receiving_models.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/character_pose.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <span>

namespace posewire::gui {

namespace {

/// "47 45 54 20   GET ", of the first half: a line that fits.
QString bytesText(std::span<const std::byte> bytes) {
    constexpr std::size_t kShown = 8;
    const auto shown = bytes.first(std::min(bytes.size(), kShown));
    const QByteArray data(reinterpret_cast<const char*>(shown.data()), static_cast<qsizetype>(shown.size()));
    return QString::fromLatin1(data.toHex(' ')) + QStringLiteral("   \"%1\"").arg(readable(shown));
}

/// "192.168.1.20 or 10.0.0.4": as many as a line takes.
QString hostsText(const ReceivingState& receiving, const InputAddress& input) {
    constexpr qsizetype kMost = 3;
    if (!input.groups.isEmpty() || !input.address.isEmpty()) {
        return input.groups.isEmpty() ? input.address : input.groups.first();
    }
    QStringList hosts;
    for (const net::LocalAddress& address : receiving.addresses) {
        if (hosts.size() < kMost && (address.isIpv4 || hosts.isEmpty())) {
            hosts += QString::fromStdString(address.address);
        }
    }
    return hosts.isEmpty() ? tr("the address of this computer") : hosts.join(tr(" or "));
}

QString openPorts(const ReceivingState& receiving) {
    QStringList open;
    for (const PortState& state : receiving.ports) {
        if (state.problem.isEmpty()) {
            open += displayText(state.port);
        }
    }
    return open.join(tr(" and "));
}

EmptyState withoutPort(const ReceivingState& receiving) {
    EmptyState state;
    state.level = Health::Error;
    state.topic = HelpTopic::CannotListen;
    for (const PortState& port : receiving.ports) {
        state.title = tr("Cannot listen on %1").arg(displayText(port.port));
        state.lines += port.problem;
    }
    if (receiving.ports.empty() && !receiving.stage.isEmpty()) {
        state.level = receiving.stageProblem.isEmpty() ? Health::Unknown : Health::Error;
        state.title = tr("Waiting for the probes of %1").arg(receiving.stage);
        state.lines = receiving.stageProblem.split(QStringLiteral("; "), Qt::SkipEmptyParts);
    } else if (receiving.ports.empty()) {
        state.level = Health::Unknown;
        state.topic = HelpTopic::NoInput;
        state.title = tr("Nothing to listen to");
        state.lines += tr("Choose Input > Inputs or File > Open.");
    }
    return state;
}

/// Empty if it resembles none that is known.
QString formatText(const model::Sender& sender) {
    const words::Fact format = sender.foreignFormat();
    return format.isNothing() ? QString() : tr("It looks like %1.").arg(said(format, words::Form::Headline));
}

EmptyState foreign(const model::Sender& sender) {
    const QString format = formatText(sender);
    const QString what = format.isEmpty() ? tr("Something else uses this port.") : format;
    return {Health::Warning,
            tr("These datagrams are not MXTP"),
            {tr("%1 from %2, the newest begins with").arg(grouped(sender.foreign), shown(sender.address())),
             bytesText(sender.foreignHead),
             tr("MXTP datagrams begin with 4d 58 54 50, \"MXTP\".") + QLatin1Char(' ') + what,
             said(sender.foreignFact(), words::Form::Advice)},
            HelpTopic::NotMxtp};
}

/// What is found beside the silence itself, and worth a line: the rest is in Help > Connection help.
void addFindings(const ReceivingState& receiving, EmptyState& state) {
    bool hasMore = false;
    for (const Advice& advice : adviceOn(receiving)) {
        if (advice.isCertain) {
            state.level = Health::Warning;
            state.lines += (advice.text + QLatin1Char(' ') + advice.remedy).trimmed();
        }
        hasMore = hasMore || advice.topic != HelpTopic::CannotListen; // its problem has a line already
    }
    if (hasMore) {
        state.lines += tr("More in Help > Connection help (Shift+F1)");
    }
}

/// Whoever is not listened to is not heard, and may be the one that is waited for.
void addAllowed(const ReceivingState& receiving, EmptyState& state) {
    if (!receiving.allowedProblem.isEmpty()) {
        state.level = Health::Warning;
        state.lines += receiving.allowedProblem;
    }
    if (receiving.refusedDatagrams != 0) {
        state.level = Health::Warning;
        state.lines += tr("%1 datagrams came from others than those listened to: see Input > Inputs, Listen "
                          "only to")
                           .arg(grouped(receiving.refusedDatagrams));
    }
}

EmptyState waiting(const ReceivingState& receiving) {
    const auto listening = std::ranges::find_if(receiving.ports, [](const PortState& state) {
        return state.problem.isEmpty() && state.port.kind != InputAddress::Kind::TcpConnection;
    });
    EmptyState state{Health::Unknown,
                     tr("Waiting for MXTP on %1").arg(openPorts(receiving)),
                     {},
                     HelpTopic::NothingArrives};
    if (listening != receiving.ports.end()) {
        const bool isUdp = listening->port.kind == InputAddress::Kind::Udp;
        state.lines = {tr("In MVN: Options > Preferences > Network Streamer"),
                       tr("host %1, port %2, protocol %3")
                           .arg(hostsText(receiving, listening->port))
                           .arg(listening->port.port)
                           .arg(isUdp ? tr("UDP") : tr("TCP"))};
    }
    for (const PortState& port : receiving.ports) {
        if (!port.id && !port.problem.isEmpty()) {
            state.lines += port.problem;
        }
    }
    addAllowed(receiving, state);
    addFindings(receiving, state);
    return state;
}

EmptyState withoutPose(model::SessionView& session, const QString& file) {
    QStringList types;
    for (const model::Stream& stream : session.roster().streams()) {
        types += QStringLiteral("%1").arg(stream.key.type, 2, 10, QLatin1Char('0'));
    }
    types.removeDuplicates();
    if (!file.isEmpty()) {
        return {Health::Warning,
                tr("No pose in %1").arg(file),
                {tr("Types in it: %1.").arg(types.join(QStringLiteral(", ")))},
                HelpTopic::NoPose};
    }
    return {Health::Warning,
            tr("Datagrams arrive, but no pose"),
            {tr("Types on the air: %1.").arg(types.join(QStringLiteral(", "))),
             tr("In MVN's Network Streamer, switch on Position + Orientation (Quaternion).")},
            HelpTopic::NoPose};
}

} // namespace

double shownAgeSeconds(model::SessionView& session, const model::CharacterKey& key) {
    const model::CharacterPose* pose = session.messages().pose(key);
    if (pose == nullptr) {
        return session.messages().ageSeconds(key);
    }
    return std::max(0.0, log::secondsOf(session.cursorStamp() - pose->stamp));
}

PropertyValue characterHealth(model::SessionView& session, const model::CharacterKey& key) {
    const model::Character* character = session.roster().find(key);
    const bool isPast = session.choices().cursor.mode == model::Cursor::Mode::Paused;
    if (character == nullptr || isPast) { // how it does now is no state of a figure of the past
        return {};
    }
    const PropertyValue state = characterState(session, *character);
    if (state.health != Health::Good) {
        return state;
    }
    if (session.messages().pose(key) == nullptr) {
        return {tr("no pose"), Health::Good};
    }
    const model::CharacterPose* pose = session.messages().pose(key);
    const model::Stream* stream =
        pose == nullptr ? nullptr
                        : session.roster().find(log::StreamKey{key.sender, key.character, pose->type});
    const double rateHz = stream == nullptr ? 0 : stream->statistics.rateHz();
    return {rateHz <= 0 ? tr("one sample") : tr("%1 Hz").arg(rateHz, 0, 'f', 0), Health::Good};
}

EmptyState emptyState(model::SessionView& session, const ReceivingState& receiving, const QString& file) {
    const auto characters = session.roster().listed();
    const bool hasPose = std::ranges::any_of(characters, [&](const model::Character* character) {
        return session.messages().pose(character->key) != nullptr;
    });
    if (hasPose) {
        return {};
    }
    if (!characters.empty()) {
        return withoutPose(session, file);
    }
    const auto stranger = std::ranges::find_if(session.roster().senders(), [](const model::Sender& sender) {
        return sender.foreign > 0 && !sender.foreignHead.empty();
    });
    if (stranger != session.roster().senders().end()) {
        return foreign(*stranger);
    }
    if (!file.isEmpty()) {
        EmptyState state{Health::Warning, tr("No character in %1").arg(file), {}, HelpTopic::EmptyFile};
        for (const model::Sender& sender : session.roster().senders()) {
            state.lines += formatText(sender);
            state.lines += said(sender.foreignFormat(), words::Form::Advice);
        }
        state.lines.removeAll(QString());
        return state;
    }
    return openPorts(receiving).isEmpty() ? withoutPort(receiving) : waiting(receiving);
}

} // namespace posewire::gui
