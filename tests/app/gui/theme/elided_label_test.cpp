// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/widgets.h"

#include "app/gui/theme/theme.h"

#include <QApplication>
#include <QImage>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

/// The columns of pixels in which something is drawn.
std::vector<int> drawnColumns(QWidget& label, int width) {
    label.resize(width, label.sizeHint().height());
    QImage picture(label.size(), QImage::Format_RGB32);
    picture.fill(Qt::black);
    label.render(&picture, {}, {}, QWidget::RenderFlags{});
    std::vector<int> columns;
    for (int x = 0; x < picture.width(); ++x) {
        for (int y = 0; y < picture.height(); ++y) {
            if (picture.pixelColor(x, y) != Qt::black) {
                columns.push_back(x);
                break;
            }
        }
    }
    return columns;
}

class ElidedLabelTest : public testing::Test {
protected:
    ElidedLabelTest() { applyTheme(*qApp, ThemeChoice::Dark); }
};

TEST_F(ElidedLabelTest, StandsAtItsSide) {
    ElidedLabel left(Qt::AlignLeft);
    ElidedLabel right(Qt::AlignRight);
    left.setText(QStringLiteral("02 Pose"), QStringLiteral(" · Anna"));
    right.setText(QStringLiteral("02 Pose"), QStringLiteral(" · Anna"));
    const int wide = 2 * left.sizeHint().width();
    EXPECT_LT(drawnColumns(left, wide).back(), wide / 2 + 2);
    EXPECT_GT(drawnColumns(right, wide).front(), wide / 2 - 2);
}

TEST_F(ElidedLabelTest, EndsInAnEllipsisWhereThereIsNoRoom) {
    ElidedLabel label(Qt::AlignLeft);
    label.setText(QStringLiteral("WWWWWWWWWW"), QStringLiteral("WWWWWWWWWW"));
    const int width = label.sizeHint().width() / 4;
    EXPECT_EQ(label.minimumSizeHint().width(), 0);
    EXPECT_LT(drawnColumns(label, width).back(), width - 1) << "cut in the middle of a letter";
    EXPECT_EQ(label.accessibleName(), QStringLiteral("WWWWWWWWWWWWWWWWWWWW"));
}

TEST_F(ElidedLabelTest, SoDoesAPassingMessage) {
    PassingMessage message(1'000, nullptr);
    message.say(QStringLiteral("WWWWWWWWWW"));
    const int width = message.sizeHint().width() / 2;
    EXPECT_LT(drawnColumns(message, width).back(), width - 1) << "cut in the middle of a letter";
    EXPECT_EQ(message.said(), QStringLiteral("WWWWWWWWWW"));
}

} // namespace
} // namespace posewire::gui
