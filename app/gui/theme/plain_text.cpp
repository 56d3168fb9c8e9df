// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/plain_text.h"

#include <QTextDocument>

namespace posewire::gui {
namespace {

/// Keeps line breaks.
const QString kBegin = QStringLiteral("<qt><span style=\"white-space:pre-wrap\">");
const QString kEnd = QStringLiteral("</span></qt>");

} // namespace

QString toolTipText(const QString& plain) {
    return Qt::mightBeRichText(plain) ? kBegin + plain.toHtmlEscaped() + kEnd : plain;
}

bool isEscapedToolTip(const QString& toolTip) {
    const QString inside = toolTip.mid(kBegin.size()).chopped(kEnd.size());
    return toolTip.startsWith(kBegin) && toolTip.endsWith(kEnd) && !inside.contains(QLatin1Char('<'));
}

QString menuText(const QString& plain) {
    constexpr qsizetype kMost = 80;
    QString text = plain.simplified();
    if (text.size() > kMost) {
        text = text.left(kMost - 1) + QStringLiteral("…");
    }
    return text.replace(QLatin1Char('&'), QStringLiteral("&&"));
}

} // namespace posewire::gui
