// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

namespace posewire::gui {

/// Makes every text longer and accented, to find those that are cut or not translated.
inline constexpr const char* kPseudoLanguage = "xx-pseudo";

/// Codes of the catalogues: "de", "en".
[[nodiscard]] QStringList languages();

/// Translates the window from now on; an empty code stands for the system's language, or English if there is
/// no catalogue of it.
void useLanguage(const QString& code);

} // namespace posewire::gui
