// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/text.h"

#include "app/gui/theme/words.h"
#include "core/model/text.h"
#include "core/wire/type_table.h"

#include <cmath>

namespace posewire::gui {

namespace {

/// The pictures of line end and tabulator, which hardly any font has, as arrows, which most have.
QString withArrows(QString text) {
    return text.replace(QChar(0x240a), QChar(0x21b5)).replace(QChar(0x2409), QChar(0x21e5));
}

/// The catalogue has the plural of the table as its source.
std::string pluralOf(const char* text, const char* one, std::uint32_t number) {
    const std::string own = tr(text, nullptr, static_cast<int>(number)).toStdString();
    return own == text ? wire::inEnglish(text, one, number) : own;
}

std::string translated(const words::Text& text, std::uint64_t number) {
    return pluralOf(text.text, text.one, static_cast<std::uint32_t>(number));
}

} // namespace

QString fromUtf8(std::string_view text) {
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QString shown(const model::ForeignText& text) {
    return withArrows(fromUtf8(text.shown()));
}

QString shownText(std::string_view bytes) {
    return withArrows(fromUtf8(model::shownText(bytes)));
}

QString typeTitle(std::uint8_t type) {
    const wire::TypeInfo* known = wire::findType(type);
    return fromUtf8(wire::typeDigits(type)) + u' ' +
           (known != nullptr ? translatedText(known->name) : tr("unknown type"));
}

QString faultText(const wire::WireError& error) {
    return fromUtf8(wire::errorText(error, pluralOf));
}

QString faultText(const wire::Notice& notice) {
    return fromUtf8(wire::noticeText(notice, pluralOf));
}

QString said(const words::Fact& fact, words::Form form) {
    return fromUtf8(words::say(fact, form, translated));
}

QString readable(std::span<const std::byte> bytes) {
    QString text;
    for (const std::byte byte : bytes) {
        const auto value = std::to_integer<char>(byte);
        text += value >= ' ' && value <= '~' ? QLatin1Char(value) : QLatin1Char('.');
    }
    return text;
}

QString grouped(std::uint64_t value) {
    return QString::fromStdString(model::grouped(value));
}

QString droppedText(std::uint64_t datagrams, bool isCounted) {
    return isCounted ? grouped(datagrams) : tr("not known here");
}

QString fixed(double value, int decimals) {
    return fromUtf8(model::fixedText(value, decimals));
}

QString signedFixed(double value, int decimals) {
    const bool roundsToZero = std::abs(value) < 0.5 * std::pow(10.0, -decimals);
    const bool hasPlus = value > 0 && std::isfinite(value) && !roundsToZero;
    return (hasPlus ? QStringLiteral("+") : QString()) + fixed(value, decimals);
}

QStringList setBits(std::uint32_t flags) {
    QStringList bits;
    for (int bit = 0; bit < 32; ++bit) {
        if ((flags >> bit & 1U) != 0) {
            bits += QString::number(bit);
        }
    }
    return bits;
}

QString milliClock(std::int64_t milliseconds) {
    const std::int64_t size = std::abs(milliseconds);
    const QTime time = QTime::fromMSecsSinceStartOfDay(static_cast<int>(size % 3'600'000));
    const QString text = QStringLiteral("%1").arg(size / 3'600'000, 2, 10, QLatin1Char('0')) +
                         time.toString(QStringLiteral(":mm:ss.zzz"));
    return milliseconds < 0 ? QStringLiteral("−") + text : text;
}

QString clockDifference(double milliseconds) {
    if (!std::isfinite(milliseconds)) {
        return fixed(milliseconds, 0);
    }
    if (std::abs(milliseconds) < 1000) {
        return signedFixed(milliseconds, 1) + QStringLiteral(" ms");
    }
    const QString text = milliClock(std::llround(milliseconds));
    return milliseconds > 0 ? QLatin1Char('+') + text : text;
}

QDateTime dateTimeOf(log::WallTime time) {
    return QDateTime::fromMSecsSinceEpoch(
        std::chrono::floor<std::chrono::milliseconds>(time).time_since_epoch().count()); // also before 1970
}

QString timeOfDay(log::WallTime time) {
    return dateTimeOf(time).toString(QStringLiteral("HH:mm:ss.zzz"));
}

QString duration(double seconds) {
    if (seconds < 10) {
        return fixed(seconds, 1) + QStringLiteral(" s");
    }
    const auto whole = [seconds](double unit) { return fixed(std::floor(seconds / unit), 0); };
    return seconds < 120    ? whole(1) + QStringLiteral(" s")
           : seconds < 7200 ? whole(60) + QStringLiteral(" min")
                            : whole(3600) + QStringLiteral(" h");
}

QString inMegabytes(std::uint64_t bytes) {
    return grouped((bytes + (std::uint64_t{1} << 19)) >> 20);
}

QString megabytes(std::uint64_t bytes) {
    return inMegabytes(bytes) + QStringLiteral(" MB");
}

} // namespace posewire::gui
