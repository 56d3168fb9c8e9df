// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <functional>
#include <optional>

class QWidget;

namespace posewire::gui {

struct TextPrompt {
    QString title;
    QString label;
    QString hint; ///< in the empty line
    QString accept;
    QString text{}; ///< to begin with
};

/// Asks for one line of text in a dialog and shows there what is wrong with it: what `problemOf` returns,
/// empty for nothing. Nothing where the operator cancels.
[[nodiscard]] std::optional<QString>
askForText(const TextPrompt& words, const std::function<QString(const QString&)>& problemOf, QWidget* parent);

} // namespace posewire::gui
