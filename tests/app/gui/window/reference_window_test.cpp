// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/texts.h"

#include "app/gui/theme/theme.h"
#include "core/export/protocol_reference.h"
#include "core/wire/type_table.h"

#include <QAbstractTextDocumentLayout>
#include <QApplication>
#include <QDir>
#include <QLineEdit>
#include <QListWidget>
#include <QPixmap>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextBrowser>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class ReferenceWindowTest : public testing::Test {
protected:
    void SetUp() override {
        applyTheme(*qApp, ThemeChoice::Dark);
        m_window = new ReferenceWindow("Protocol reference",
                                       QString::fromStdString(exporting::protocolReference()), nullptr);
        m_window->show();
        QApplication::processEvents();
    }
    void TearDown() override { delete m_window; }

    ReferenceWindow* m_window = nullptr;
};

TEST_F(ReferenceWindowTest, ListsEveryTypeInItsContents) {
    for (const wire::TypeInfo& info : wire::typeTable()) {
        const auto found = m_window->contents().findItems(QString::fromStdString(wire::typeTitle(info.type)),
                                                          Qt::MatchExactly);
        EXPECT_EQ(found.size(), 1) << int{info.type};
    }
}

TEST_F(ReferenceWindowTest, FollowsTheLinksOfTheOverviewToTheSections) {
    for (const wire::TypeInfo& info : wire::typeTable()) {
        const std::string title = wire::typeTitle(info.type);
        EXPECT_TRUE(m_window->goTo(QString::fromStdString(exporting::headingAnchor(title)))) << title;
    }
    EXPECT_FALSE(m_window->goTo("no-such-heading"));
    ASSERT_TRUE(m_window->goTo("13-null-pose"));
    EXPECT_EQ(m_window->browser().textCursor().block().text(), "13 Null pose");
    EXPECT_GT(m_window->browser().verticalScrollBar()->value(), 0);
}

TEST_F(ReferenceWindowTest, ShowsEveryHeadingInEachTheme) {
    for (const ThemeChoice choice : {ThemeChoice::Light, ThemeChoice::Dark}) {
        applyTheme(*qApp, choice);
        QApplication::processEvents();
        const QTextDocument& document = *m_window->browser().document();
        for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
            if (block.blockFormat().headingLevel() != 0) {
                EXPECT_GT(document.documentLayout()->blockBoundingRect(block).height(), 10)
                    << block.text().toStdString();
            }
        }
    }
}

TEST_F(ReferenceWindowTest, FindsAFieldAndBeginsAgainAtTheTop) {
    m_window->searchEdit().setText("freeAcceleration");
    const int first = m_window->browser().textCursor().selectionStart();
    EXPECT_EQ(m_window->browser().textCursor().selectedText(), "freeAcceleration");
    ASSERT_TRUE(m_window->find(false));
    EXPECT_GT(m_window->browser().textCursor().selectionStart(), first);
    ASSERT_TRUE(m_window->find(false));
    EXPECT_EQ(m_window->browser().textCursor().selectionStart(), first);
    m_window->searchEdit().setText("no such words");
    EXPECT_FALSE(m_window->find(true));
}

TEST_F(ReferenceWindowTest, IsPhotographedInBothThemes) {
    ASSERT_TRUE(QDir().mkpath("pictures"));
    for (const auto& [choice, name] : {std::pair{ThemeChoice::Dark, "dark"}, {ThemeChoice::Light, "light"}}) {
        applyTheme(*qApp, choice);
        QApplication::processEvents();
        m_window->goTo("protocol-reference");
        EXPECT_TRUE(m_window->grab().save(QString("pictures/reference-%1.png").arg(name)));
        m_window->goTo("13-null-pose");
        EXPECT_TRUE(m_window->grab().save(QString("pictures/reference-type13-%1.png").arg(name)));
    }
}

} // namespace
} // namespace posewire::gui
