// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/time.h"
#include "core/model/foreign_text.h"
#include "core/wire/faults.h"
#include "core/words/say.h"

#include <QDateTime>
#include <QString>
#include <QStringList>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// How figures are written everywhere in the window: fixed decimals, a true minus, thousands set apart.
namespace posewire::gui {

[[nodiscard]] QString shown(const model::ForeignText& text);
[[nodiscard]] QString shownText(std::string_view bytes);

/// UTF-8 of the core's own words as a text of the window.
[[nodiscard]] QString fromUtf8(std::string_view text);

/// "02 Pose, quaternion", or "77 unknown type".
[[nodiscard]] QString typeTitle(std::uint8_t type);

/// Why a datagram cannot be decoded, and what is odd about one, in the operator's language.
[[nodiscard]] QString faultText(const wire::WireError& error);
[[nodiscard]] QString faultText(const wire::Notice& notice);

/// A fact in words, in the operator's language if there is a catalogue for it.
[[nodiscard]] QString said(const words::Fact& fact, words::Form form);

/// The bytes as letters of ASCII, with a dot for each that is none.
[[nodiscard]] QString readable(std::span<const std::byte> bytes);

/// "–": nothing to show.
[[nodiscard]] inline QString dash() {
    return QStringLiteral("–");
}

/// 153402 as "153 402", with narrow no-break spaces.
[[nodiscard]] QString grouped(std::uint64_t value);

/// Datagrams that this computer dropped, or "not known here" if its system does not count them.
[[nodiscard]] QString droppedText(std::uint64_t datagrams, bool isCounted);

/// "−0.05"; "–" where the value is not finite. A value that rounds to zero has no sign.
[[nodiscard]] QString fixed(double value, int decimals);

/// The same with "+" before values above zero.
[[nodiscard]] QString signedFixed(double value, int decimals);

/// The bits that are set, the lowest, 0, first.
[[nodiscard]] QStringList setBits(std::uint32_t flags);

/// Milliseconds as a clock, "00:10:39.175"; hours may exceed 24.
[[nodiscard]] QString milliClock(std::int64_t milliseconds);

/// A difference of clocks: "+3.1 ms" below a second, else "−00:00:01.508".
[[nodiscard]] QString clockDifference(double milliseconds);

/// In the computer's own zone.
[[nodiscard]] QDateTime dateTimeOf(log::WallTime time);
/// The same without the date: "10:42:17.508".
[[nodiscard]] QString timeOfDay(log::WallTime time);

/// "0.4 s", "3.2 s", "12 min", "3 h": as long as a duration is interesting to the digit.
[[nodiscard]] QString duration(double seconds);

/// "211": binary megabytes, as the limit is set in.
[[nodiscard]] QString inMegabytes(std::uint64_t bytes);
/// "211 MB".
[[nodiscard]] QString megabytes(std::uint64_t bytes);

} // namespace posewire::gui
