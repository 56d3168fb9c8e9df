// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/widgets.h"

#include <QApplication>
#include <QFont>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

const QFontMetricsF& metrics() {
    static const QFontMetricsF ofApplication{QApplication::font()};
    return ofApplication;
}

int linesAt(const QString& text, qreal width) {
    return qRound(metrics().boundingRect({0, 0, width, 1e6}, Qt::TextWordWrap, text).height() /
                  metrics().height());
}

TEST(BalancedText, LeavesNoWordAloneInTheLastLine) {
    const QString text = QStringLiteral("one two three four five six seven");
    const qreal most = metrics().horizontalAdvance(text) - 2; // the last word does not fit
    const qreal width = balancedWidth(metrics(), text, most);
    EXPECT_EQ(linesAt(text, width), 2);
    EXPECT_LT(width, 0.65 * most);
}

TEST(BalancedText, KeepsLinesThatAreSaid) {
    const QString text = QStringLiteral("Nothing yet.\nWhat arrives is listed here.");
    EXPECT_EQ(linesAt(text, balancedWidth(metrics(), text, 1e4)), 2);
}

TEST(BalancedText, IsNeverNarrowerThanAWord) {
    const QString word = QStringLiteral("Donaudampfschifffahrt");
    EXPECT_GE(balancedWidth(metrics(), word, 1e4) + 1, metrics().horizontalAdvance(word));
    EXPECT_EQ(balancedWidth(metrics(), word, 20), 20);
}

} // namespace
} // namespace posewire::gui
