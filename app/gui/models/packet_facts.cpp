// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_facts.h"

#include "app/gui/models/column.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/accounting/attribution.h"
#include "core/model/session/accounts.h"
#include "core/wire/codec.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace posewire::gui {

namespace {

/// "47 45 54 20 2f "GET /""
QString beginning(wire::Bytes bytes) {
    constexpr std::size_t kShown = 12;
    const wire::Bytes shown = bytes.first(std::min(bytes.size(), kShown));
    const QString digits = QString::fromLatin1(QByteArrayView(shown).toByteArray().toHex(' '));
    const QString more = bytes.size() > kShown ? QStringLiteral(" …") : QString();
    return digits + more + QStringLiteral("  \"") + readable(shown) + QLatin1Char('"');
}

/// Why it cannot be decoded, or what is odd about it.
QStringList decodedFindings(const log::Packet& packet) {
    const auto decoded = wire::decode(packet.bytes);
    if (!decoded) {
        return {tr("malformed: %1").arg(faultText(decoded.error()))};
    }
    QStringList texts;
    for (const wire::Notice& notice : decoded->notices) {
        texts += faultText(notice);
    }
    return texts;
}

/// "network: 3 lost": whose loss it was comes first, for where there is little room.
QString gapText(const model::Gap* gap, std::uint64_t samples) {
    if (gap == nullptr || !gap->isJudged) {
        return tr("gap: %1 missing").arg(grouped(samples));
    }
    const bool isKnown = gap->mainCause() != model::LossCause::Unknown;
    return tr("%1: %2 lost")
        .arg(isKnown ? translatedText(model::nameOf(gap->mainCause())) : tr("cause unknown"),
             grouped(samples));
}

/// The texts of what is so.
QStringList trueOf(std::initializer_list<std::pair<bool, QString>> findings) {
    QStringList texts;
    for (const auto& [isSo, text] : findings) {
        if (isSo) {
            texts += text;
        }
    }
    return texts;
}

QString findingsOf(model::SessionView& view, const log::Packet& packet, const model::PacketDigest& digest) {
    QStringList texts;
    if (digest.kind == model::PacketKind::Malformed) {
        texts += decodedFindings(packet);
    }
    if (digest.kind == model::PacketKind::Foreign) {
        texts += packet.bytes.empty() ? tr("foreign: empty") : tr("foreign: %1").arg(beginning(packet.bytes));
    }
    if (digest.kind == model::PacketKind::Skipped) {
        texts += tr("belongs to no datagram: %1").arg(beginning(packet.bytes));
    }
    if (digest.followsDrops) {
        texts += tr("this computer dropped %1 before").arg(grouped(packet.kernelDropsBefore));
    }
    if (digest.gap != 0) {
        texts += gapText(view.accounts().attribution().endedBy(packet.number), digest.gap);
    }
    texts += trueOf({{digest.isDuplicate, tr("duplicate")},
                     {digest.isReordered, tr("reordered")},
                     {digest.isRestart, tr("counter restarted")},
                     {digest.isInDoubt, tr("counter jumped")},
                     {digest.isTruncated, tr("cut off when it was received")}});
    if (packet.flags.shared != 0) {
        texts += said(words::sharedFact(packet.flags.shared), words::Form::Sentence);
    }
    if (digest.hasNotices) {
        texts += decodedFindings(packet);
    }
    return texts.join(QStringLiteral(" · "));
}

} // namespace

QStringList sequenceFindings(model::SessionView& view, std::uint64_t number) {
    const model::PacketDigest* digest = view.accounts().digests().find(number);
    if (digest == nullptr) {
        return {};
    }
    QStringList texts;
    if (digest->followsDrops) {
        const auto packet = view.packet(number);
        texts += tr("Just before it this computer dropped %1 datagrams of the port.")
                     .arg(packet ? grouped(packet->kernelDropsBefore) : QStringLiteral("?"));
    }
    if (digest->gap != 0) {
        const model::Gap* gap = view.accounts().attribution().endedBy(number);
        QStringList sentences{
            tr("%1 samples are missing just before it.", nullptr, static_cast<int>(digest->gap))
                .arg(grouped(digest->gap))};
        for (const model::LossCause cause :
             gap != nullptr ? gap->causes() : std::vector<model::LossCause>()) {
            sentences += tr("Cause: %1. %2")
                             .arg(translatedText(model::nameOf(cause)),
                                  said(gap->evidenceFact(cause), words::Form::Sentence));
        }
        texts += sentences.join(QLatin1Char(' '));
    }
    return texts +
           trueOf({{digest->isDuplicate, tr("Duplicate: this datagram of this sample had come before.")},
                   {digest->isReordered, tr("Reordered: a later sample of the stream came before it.")},
                   {digest->isRestart, tr("The sample counter of the stream restarted here.")},
                   {digest->isInDoubt, tr("The sample counter jumped here. What comes next shows whether "
                                          "it restarted.")}});
}

std::optional<PacketFacts> packetFacts(model::SessionView& view, std::uint64_t number) {
    const model::PacketDigest* digest = view.accounts().digests().find(number);
    const auto packet = digest != nullptr ? view.packet(number) : std::nullopt;
    if (!packet) {
        return std::nullopt;
    }
    PacketFacts facts{number, packet->stamp, packet->sender, packet->bytes.size(), *digest, {}, {}};
    if (!isStrange(*digest)) {
        if (const auto header = wire::decodeHeader(packet->bytes)) {
            facts.header = *header;
        }
    }
    if (digest->isProblem()) {
        facts.findings = findingsOf(view, *packet, *digest);
    }
    return facts;
}

bool isStrange(const model::PacketDigest& digest) {
    return digest.kind == model::PacketKind::Foreign || digest.kind == model::PacketKind::Skipped;
}

Health packetHealth(const PacketFacts& facts) {
    const model::PacketDigest& digest = facts.digest;
    if (digest.kind == model::PacketKind::Malformed || digest.isTruncated) {
        return Health::Error;
    }
    return digest.isProblem() ? Health::Warning : Health::Unknown;
}

QString packetType(const PacketFacts& facts) {
    if (isStrange(facts.digest)) {
        return facts.digest.kind == model::PacketKind::Foreign ? tr("foreign") : tr("stray bytes");
    }
    return facts.digest.kind == model::PacketKind::Malformed && !facts.header ? tr("malformed")
                                                                              : typeTitle(facts.digest.type);
}

QString packetPart(model::SessionView& view, const PacketFacts& facts) {
    if (!facts.header) {
        return {};
    }
    const wire::Header& own = *facts.header;
    const QString place = QString::number(own.datagramIndex() + 1);
    if (own.isLast()) {
        return place + QLatin1Char('/') + place;
    }
    constexpr std::uint64_t kNear = 64;
    const std::uint64_t end = std::min(view.end(), facts.number + kNear);
    for (std::uint64_t number = facts.number + 1; number < end; ++number) {
        const model::PacketDigest* digest = view.accounts().digests().find(number);
        if (digest == nullptr || digest->type != facts.digest.type ||
            digest->character != facts.digest.character) {
            continue;
        }
        const auto packet = view.packet(number);
        const auto header = packet ? wire::decodeHeader(packet->bytes) : wire::Result<wire::Header>();
        if (packet && packet->sender == facts.sender && header && header->isLast() &&
            header->sampleCounter == own.sampleCounter && header->datagramIndex() > own.datagramIndex()) {
            return place + QLatin1Char('/') + QString::number(header->datagramIndex() + 1);
        }
    }
    return place + QStringLiteral("/?");
}

QString packetNote(model::SessionView& view, const PacketFacts& facts, NoteFor reader) {
    const bool isSpoken = reader == NoteFor::Ear;
    const PropertyValue findings{facts.findings, packetHealth(facts)};
    QString note = facts.findings.isEmpty() ? QString() : isSpoken ? findings.spoken() : findings.display();
    const model::Annotations& annotations = view.choices().annotations;
    if (annotations.marks.contains(facts.number)) {
        const QString mark = isSpoken ? QString() : QStringLiteral("◆ ");
        note.prepend(mark + (note.isEmpty() ? tr("marked") : isSpoken ? tr("marked, ") : QString()));
    }
    if (const auto comment = annotations.comments.find(facts.number); comment != annotations.comments.end()) {
        note += (note.isEmpty() ? QStringLiteral("“") : QStringLiteral(" · “")) +
                shownText(QString::fromStdString(comment->second).simplified().toStdString()) +
                QStringLiteral("”");
    }
    return note;
}

} // namespace posewire::gui
