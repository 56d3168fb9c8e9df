// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QCoreApplication>
#include <QString>

#include <string_view>

namespace posewire::gui {

/// A text of the window in the operator's language, for functions that belong to no QObject. Include this in
/// implementations only.
[[nodiscard]] inline QString tr(const char* text, const char* about = nullptr, int number = -1) {
    return QCoreApplication::translate("posewire::gui", text, about, number);
}

/// A whole text of a table of the core, such as the name of a message type, in the operator's language.
[[nodiscard]] inline QString translatedText(std::string_view text) {
    const QByteArray source(text.data(), static_cast<qsizetype>(text.size()));
    return source.isEmpty() ? QString() : QCoreApplication::translate("posewire::core", source.constData());
}

} // namespace posewire::gui
