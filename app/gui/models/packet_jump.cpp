// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_jump.h"

#include "app/gui/models/display_filter.h"
#include "app/gui/models/packet_search.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/theme/words.h"
#include "core/filter/filter.h"
#include "core/model/session/accounts.h"

namespace posewire::gui {

namespace {

/// A click may take a tenth of a second: digests that are looked at, and packets that are decoded.
constexpr std::uint64_t kMostDigests = 4'000'000;
constexpr int kMostDecoded = 20'000;

/// Asks a filter about single packets.
class Question {
public:
    Question(model::SessionView& view, filter::Filter filter)
        : m_view(view),
          m_filter(std::move(filter)),
          m_senders(view.log().senders()),
          m_units(m_filter.comparesLengths() ? unusualPositionUnits(view) : PositionUnits()) {}

    [[nodiscard]] bool isYes(std::uint64_t number) {
        const auto packet = m_view.packet(number);
        const model::PacketDigest* digest = m_view.accounts().digests().find(number);
        if (!packet || digest == nullptr) {
            return false;
        }
        const bool isRead = !packet->flags.skipped && wire::decodeInto(packet->bytes, m_datagram).has_value();
        return m_filter.matches({*packet, *digest, isRead ? &m_datagram : nullptr,
                                 m_senders.find(packet->sender), m_view.firstStamp(), nullptr,
                                 m_view.log().timeline().setByAt(packet->stamp),
                                 unitIn(m_units, packet->sender, digest->type)});
    }

private:
    model::SessionView& m_view;
    filter::Filter m_filter;
    log::SenderFinder m_senders;
    PositionUnits m_units;
    wire::Datagram m_datagram;
};

bool mayBe(const PacketsBehind& behind, const model::PacketDigest& digest) {
    return (!behind.type || digest.type == *behind.type) &&
           (!behind.character || digest.character == *behind.character) &&
           (!behind.isTrouble || digest.isProblem());
}

/// The newest of those from one packet to before another.
std::optional<std::uint64_t> newestIn(model::SessionView& view, const PacketsBehind& behind,
                                      Question& question, std::uint64_t from, std::uint64_t end) {
    const model::PacketDigests& digests = view.accounts().digests();
    const std::uint64_t oldest = std::max({digests.begin(), from, end - std::min(end, kMostDigests)});
    int decoded = 0;
    for (std::uint64_t number = end; number-- > oldest && decoded < kMostDecoded;) {
        const model::PacketDigest* digest = digests.find(number);
        if (digest != nullptr && mayBe(behind, *digest)) {
            ++decoded;
            if (question.isYes(number)) {
                return number;
            }
        }
    }
    return std::nullopt;
}

/// The newest up to the cursor; where there is none, the newest there is.
std::optional<std::uint64_t> newestBehind(model::SessionView& view, const PacketsBehind& behind) {
    const auto filter = filter::Filter::compile(behind.filter.toStdString());
    if (!filter || view.end() == 0) {
        return std::nullopt;
    }
    Question question(view, *filter);
    const std::uint64_t visibleEnd = newestVisiblePacket(view) + 1;
    const auto before = newestIn(view, behind, question, 0, visibleEnd);
    return before ? before : newestIn(view, behind, question, visibleEnd, view.end());
}

} // namespace

bool isListed(model::SessionView& view, const QString& filter, std::uint64_t packet) {
    auto compiled = filter::Filter::compile(filter.trimmed().toStdString());
    return !compiled || Question(view, *std::move(compiled)).isYes(packet);
}

bool showPackets(model::SessionView& view, Commands& commands, const PacketsBehind& behind, PacketLook look) {
    const auto packet = behind.packet ? behind.packet : newestBehind(view, behind);
    if (!packet || !view.packet(*packet)) {
        return false;
    }
    QString filter = QString::fromStdString(view.choices().ownFilter());
    const QString alone =
        behind.filter.isEmpty() ? QStringLiteral("number == %1").arg(*packet) : behind.filter;
    if (look == PacketLook::Alone) {
        filter = alone;
    } else if (!isListed(view, filter, *packet)) {
        // Beside the packets that a limit or an outage is about lies the one to go to.
        filter = joinedFilter(
            filter, isListed(view, alone, *packet) ? alone : QStringLiteral("number == %1").arg(*packet),
            FilterJoin::Or);
    }
    commands.jump(*packet, filter);
    commands.showDock(QStringLiteral("packets"));
    return true;
}

QString noPacketsText() {
    return tr("None of these packets is in memory any more.");
}

} // namespace posewire::gui
