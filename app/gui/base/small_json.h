// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QJsonObject>
#include <QString>

#include <tl/expected.hpp>

namespace posewire::gui {

/// No text of a file of ours is longer, no list or object has more entries, and none lies deeper.
inline constexpr int kLongestJsonText = 16'384;
inline constexpr int kMostJsonEntries = 256;
inline constexpr int kDeepestJson = 16;

/// An object of the program's own kind, such as settings or a layout, that anyone may have written since:
/// what is larger than ours ever is has been left out, so that whoever reads a value of it need not fear its
/// size. The error says what is wrong, and where.
[[nodiscard]] tl::expected<QJsonObject, QString> parseSmallObject(const QByteArray& json);

} // namespace posewire::gui
