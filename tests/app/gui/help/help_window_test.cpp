// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/help/help_window.h"

#include "app/gui/theme/theme.h"
#include "app/gui/window/guide.h"

#include <QAbstractTextDocumentLayout>
#include <QApplication>
#include <QLineEdit>
#include <QListWidget>
#include <QScrollBar>
#include <QTest>
#include <QTextBlock>
#include <QToolButton>
#include <QTreeWidget>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class HelpWindowTest : public testing::Test {
protected:
    void SetUp() override {
        applyTheme(*qApp, ThemeChoice::Dark);
        window.resize(1000, 700);
        window.open("index");
        QTest::qWait(1);
    }
    void type(const QString& words) { QTest::keyClicks(window.findChild<QLineEdit*>(), words); }
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
        QTest::keyClick(QApplication::focusWidget() != nullptr ? QApplication::focusWidget() : &window, key,
                        modifiers);
    }
    [[nodiscard]] QString firstBlock() const { return window.view().document()->firstBlock().text(); }

    const HelpPages pages{madeHelpParts()};
    HelpWindow window{pages, nullptr};
};

TEST_F(HelpWindowTest, ShowsAPlaceOnAPage) {
    window.open("causes#network");
    EXPECT_EQ(firstBlock(), "What a cause means");
    EXPECT_EQ(window.view().textCursor().block().text(), "Network");
    EXPECT_GT(window.view().verticalScrollBar()->value(), 0);
    EXPECT_EQ(window.contents().currentItem()->text(0), "What a cause means");
}

TEST_F(HelpWindowTest, AWindowThatWasNotOpenShowsThePlaceToo) {
    HelpWindow fresh(pages, nullptr);
    fresh.resize(1000, 700);
    fresh.open("messages#a-file-cannot-be-opened");
    QTest::qWait(1);
    EXPECT_EQ(fresh.view().cursorForPosition({200, 8}).block().text(), "A file cannot be opened");
}

TEST_F(HelpWindowTest, APageOfTheContentsCanBeClickedAndIsLaidOut) {
    for (const char* title : {"Metadata", "Statistics", "Metadata"}) {
        const auto items = window.contents().findItems(title, Qt::MatchExactly | Qt::MatchRecursive);
        ASSERT_EQ(items.size(), 1);
        window.contents().scrollToItem(items.front());
        QTest::mouseClick(window.contents().viewport(), Qt::LeftButton, {},
                          window.contents().visualItemRect(items.front()).center());
        EXPECT_EQ(firstBlock(), title);
        EXPECT_GT(window.view().document()->pageSize().width(), 300);
        EXPECT_EQ(window.view().cursorForPosition({200, 30}).block().text(), title);
    }
}

TEST_F(HelpWindowTest, TheContentsHaveRoomForEveryTitle) {
    HelpWindow fresh(pages, nullptr);
    fresh.open("index");
    QTest::qWait(1);
    const QAbstractItemView& titles = fresh.contents();
    EXPECT_GE(titles.viewport()->width(), titles.sizeHintForColumn(0));
    EXPECT_EQ(fresh.windowTitle(), "Posewire user guide");
    fresh.open("packets");
    EXPECT_EQ(fresh.windowTitle(), "Packets – Posewire user guide");
}

TEST_F(HelpWindowTest, ShowsTheFirstPageForAPlaceThatIsNone) {
    window.open("packets");
    window.open("nonsense#here");
    EXPECT_EQ(window.place(), "index");
    window.open({});
    EXPECT_EQ(firstBlock(), "Posewire user guide");
}

TEST_F(HelpWindowTest, GoesBackToWhereItWasAndForwardAgain) {
    window.open("causes");
    window.view().verticalScrollBar()->setValue(120);
    window.open("packets");
    window.view().backward();
    EXPECT_EQ(window.place(), "causes");
    EXPECT_EQ(window.view().verticalScrollBar()->value(), 120);
    window.view().forward();
    EXPECT_EQ(window.place(), "packets");
    window.view().forward();
    EXPECT_EQ(window.place(), "packets") << "there is no further page";
    window.view().backward();
    window.open("glossary");
    window.view().forward();
    EXPECT_EQ(window.place(), "glossary") << "what came after was left";
}

TEST_F(HelpWindowTest, FollowsTheLinksOfAPage) {
    emit window.view().anchorClicked(QUrl("dropped-packets.md"));
    EXPECT_EQ(window.place(), "dropped-packets");
    emit window.view().anchorClicked(QUrl("causes.md#unknown"));
    EXPECT_EQ(window.view().textCursor().block().text(), "Unknown");
    emit window.view().anchorClicked(QUrl("#network"));
    EXPECT_EQ(window.place(), "causes#network");
    emit window.view().anchorClicked(QUrl("https://example.org"));
    EXPECT_EQ(window.place(), "causes#network");
}

TEST_F(HelpWindowTest, FollowsALinkThatTheViewHasResolved) {
    window.open("causes");
    emit window.view().anchorClicked(QUrl("causes#network"));
    EXPECT_EQ(window.place(), "causes#network");
    EXPECT_EQ(window.view().textCursor().block().text(), "Network");
}

TEST_F(HelpWindowTest, ShowsEveryHeadingOfTheProtocolReferenceInEachTheme) {
    window.open("protocol#13-null-pose");
    EXPECT_EQ(window.view().textCursor().block().text(), "13 Null pose");
    EXPECT_GT(window.view().verticalScrollBar()->value(), 0);
    for (const ThemeChoice choice : {ThemeChoice::Light, ThemeChoice::Dark}) {
        applyTheme(*qApp, choice);
        QApplication::processEvents();
        const QTextDocument& document = *window.view().document();
        for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
            if (block.blockFormat().headingLevel() != 0) {
                EXPECT_GT(document.documentLayout()->blockBoundingRect(block).height(), 10)
                    << block.text().toStdString();
            }
        }
    }
}

TEST_F(HelpWindowTest, FindsAFieldOfTheReferenceAndBeginsAgainAtTheTop) {
    window.open("protocol");
    ASSERT_TRUE(window.view().findAgain("freeAcceleration", false));
    const int first = window.view().textCursor().selectionStart();
    ASSERT_TRUE(window.view().findAgain("freeAcceleration", false));
    EXPECT_GT(window.view().textCursor().selectionStart(), first);
    ASSERT_TRUE(window.view().findAgain("freeAcceleration", false));
    EXPECT_EQ(window.view().textCursor().selectionStart(), first);
    EXPECT_FALSE(window.view().findAgain("no such words", true));
}

TEST_F(HelpWindowTest, ASearchListsPagesInsteadOfTheContentsAndMarksWhatItFound) {
    type("firewall");
    EXPECT_TRUE(window.hits().isVisible());
    EXPECT_FALSE(window.contents().isVisible());
    ASSERT_GT(window.hits().count(), 0);
    EXPECT_GT(window.hits().visualItemRect(window.hits().item(0)).height(),
              2 * window.hits().fontMetrics().height())
        << "the excerpt is shown";
    EXPECT_TRUE(window.hits().item(0)->text().startsWith("Inputs and the network on site\n"));
    QTest::keyClick(window.findChild<QLineEdit*>(), Qt::Key_Return);
    EXPECT_EQ(window.place(), "network");
    EXPECT_EQ(window.view().textCursor().selectedText().toLower(), "firewall");
    EXPECT_FALSE(window.view().extraSelections().isEmpty());
    const int first = window.view().textCursor().position();
    QTest::keyClick(window.findChild<QLineEdit*>(), Qt::Key_Return);
    EXPECT_NE(window.view().textCursor().position(), first) << "Enter goes to the next place";
}

TEST_F(HelpWindowTest, EscapeEndsTheSearchAndThenTheWindow) {
    type("firewall");
    QTest::keyClick(window.findChild<QLineEdit*>(), Qt::Key_Escape);
    EXPECT_TRUE(window.findChild<QLineEdit*>()->text().isEmpty());
    EXPECT_TRUE(window.contents().isVisible());
    EXPECT_TRUE(window.isVisible());
    EXPECT_TRUE(window.view().extraSelections().isEmpty());
    QTest::keyClick(window.findChild<QLineEdit*>(), Qt::Key_Escape);
    EXPECT_FALSE(window.isVisible());
}

TEST_F(HelpWindowTest, TheKeyboardReachesEverything) {
    window.activateWindow();
    QTest::keyClick(&window.view(), Qt::Key_F, Qt::ControlModifier);
    EXPECT_TRUE(window.findChild<QLineEdit*>()->hasFocus());
    window.open("packets");
    QTest::keyClick(&window.view(), Qt::Key_Left, Qt::AltModifier);
    EXPECT_EQ(window.place(), "index");
    QTest::keyClick(&window.view(), Qt::Key_Right, Qt::AltModifier);
    EXPECT_EQ(window.place(), "packets");
    QTest::keyClick(&window.view(), Qt::Key_Home, Qt::AltModifier);
    EXPECT_EQ(window.place(), "index");
    window.contents().setFocus();
    QTest::keyClick(&window.contents(), Qt::Key_Down); // the chapter
    QTest::keyClick(&window.contents(), Qt::Key_Down);
    EXPECT_NE(window.place(), "index") << "the contents open what is chosen";
}

TEST_F(HelpWindowTest, EverythingHasANameForScreenReaders) {
    for (const QToolButton* button : window.findChildren<QToolButton*>()) {
        if (button->objectName().startsWith("_q") || button->parent() == window.findChild<QLineEdit*>()) {
            continue; // of the line itself
        }
        EXPECT_GT(button->accessibleName().size(), 2) << button->text().toStdString();
    }
    for (const QWidget* part : std::initializer_list<const QWidget*>{
             &window.view(), &window.contents(), &window.hits(), window.findChild<QLineEdit*>()}) {
        EXPECT_FALSE(part->accessibleName().isEmpty());
    }
}

TEST_F(HelpWindowTest, APictureIsNoWiderThanItsRoom) {
    window.open("check-a-stream");
    for (const int width : {700, 1000, 1700}) {
        window.resize(width, 700);
        QTest::qWait(1);
        const QVariant picture =
            window.view().document()->resource(QTextDocument::ImageResource, QUrl("pictures/check-good.png"));
        const auto pixmap = picture.value<QPixmap>();
        ASSERT_FALSE(pixmap.isNull());
        EXPECT_LE(pixmap.deviceIndependentSize().width(), window.view().viewport()->width());
        EXPECT_EQ(window.view().horizontalScrollBar()->maximum(), 0) << width;
    }
}

TEST_F(HelpWindowTest, LinksHaveTheColoursOfTheThemeAlsoAfterItChanged) {
    for (const ThemeChoice choice : {ThemeChoice::Light, ThemeChoice::Dark}) {
        applyTheme(*qApp, choice);
        QApplication::processEvents();
        int links = 0;
        for (QTextBlock block = window.view().document()->begin(); block.isValid(); block = block.next()) {
            for (auto at = block.begin(); !at.atEnd(); ++at) {
                if (at.fragment().charFormat().isAnchor()) {
                    EXPECT_EQ(at.fragment().charFormat().foreground().color(), theme().accent);
                    ++links;
                }
            }
        }
        EXPECT_GT(links, 10);
    }
}

} // namespace
} // namespace posewire::gui
