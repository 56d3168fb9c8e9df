// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/fitting_header.h"

#include "app/gui/models/column.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/theme.h"

#include <QStandardItemModel>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

/// A name, a verdict that takes the room left, and two figures.
class FittingHeaderTest : public testing::Test {
protected:
    enum Column : int { kName, kVerdict, kRate, kAge };

    FittingHeaderTest() {
        m_model.setHorizontalHeaderLabels({"Name", "Verdict", "Rate", "Age"});
        give(kName, {"A performer's name", "A performer's name that is long", "A perf"});
        give(kVerdict, {.usual = kVerdictSample, .isOpen = true});
        give(kRate, {.usual = "1000.0", .order = 2});
        give(kAge, {.usual = "99.9", .order = 1});
        m_table.setModel(&m_model);
        m_table.setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        m_table.show();
    }
    void give(Column column, const ColumnRoom& room) {
        m_model.setHeaderData(column, Qt::Horizontal, QVariant::fromValue(room), kRoomRole);
    }
    void addRow(const QString& verdict, const QString& rate) {
        m_model.appendRow({new QStandardItem("Name"), new QStandardItem(verdict), new QStandardItem(rate),
                           new QStandardItem("0.1")});
    }
    void makeWide(int width) { m_table.resize(width, 200); }
    [[nodiscard]] static int widthOf(const QString& text) {
        return QFontMetrics(tabularFont()).horizontalAdvance(text);
    }
    [[nodiscard]] bool scrolls() const { return m_table.columns().length() > m_table.viewport()->width(); }

    static constexpr const char* kVerdictSample = "10.0 % lost, network";
    QStandardItemModel m_model;
    TableView m_table{"Board"};
};

TEST_F(FittingHeaderTest, GivesUpFiguresBeforeItMakesNamesNarrower) {
    int width = 2000;
    makeWide(width);
    while (!m_table.isColumnHidden(kAge)) {
        makeWide(--width);
    }
    EXPECT_FALSE(m_table.isColumnHidden(kRate));
    EXPECT_GE(m_table.columnWidth(kName), widthOf("A performer's name"));
    EXPECT_FALSE(scrolls());
}

TEST_F(FittingHeaderTest, MakesNamesNarrowerBeforeItGivesUpFiguresWhereThatIsWanted) {
    give(kName, {.usual = "A perf", .wish = "A performer's name that is long"});
    makeWide(2000);
    int width = 2000;
    while (!m_table.isColumnHidden(kAge)) {
        EXPECT_FALSE(scrolls()) << width;
        makeWide(--width);
    }
    EXPECT_LT(width, widthOf("A performer's name") + widthOf(kVerdictSample) + widthOf("1000.099.9"));
}

TEST_F(FittingHeaderTest, MakesNamesNarrowerBeforeItCutsTheVerdict) {
    makeWide(widthOf("A perf") + widthOf(kVerdictSample) + widthOf("xxxxxxxxx"));
    EXPECT_TRUE(m_table.isColumnHidden(kRate));
    EXPECT_GE(m_table.columnWidth(kVerdict), widthOf(kVerdictSample));
    EXPECT_LT(m_table.columnWidth(kName), widthOf("A performer's name"));
    EXPECT_FALSE(scrolls());
}

TEST_F(FittingHeaderTest, NeverCutsAFigure) {
    m_model.setHeaderData(kRate, Qt::Horizontal, QVariant(Qt::AlignRight), Qt::TextAlignmentRole);
    makeWide(800);
    const int usual = m_table.columnWidth(kRate);
    addRow("good", "60.0");
    EXPECT_EQ(m_table.columnWidth(kRate), usual);
    m_model.item(0, kRate)->setText("10 062 457.0");
    EXPECT_GE(m_table.columnWidth(kRate), widthOf("10 062 457.0"));
    m_model.item(0, kRate)->setText("1.0");
    EXPECT_GE(m_table.columnWidth(kRate), widthOf("10 062 457.0")) << "nothing jumps";
}

TEST_F(FittingHeaderTest, MakesTheVerdictWiderBeforeNamesWhereThatIsWished) {
    const char* words = "10.0 % lost, network, since 10:42:17";
    const int room = widthOf(words) - widthOf(kVerdictSample);
    makeWide(2000);
    int width = 2000;
    while (!m_table.isColumnHidden(kAge)) {
        makeWide(--width);
    }
    makeWide(width + 1 + room);
    EXPECT_LT(m_table.columnWidth(kVerdict), widthOf(words)) << "names have the room";
    give(kVerdict, {.usual = kVerdictSample, .wish = words, .isOpen = true});
    EXPECT_GE(m_table.columnWidth(kVerdict), widthOf(words));
    EXPECT_GE(m_table.columnWidth(kName), widthOf("A performer's name"));
    makeWide(2000);
    EXPECT_GE(m_table.columnWidth(kName), widthOf("A performer's name that is long"));
}

TEST_F(FittingHeaderTest, KeepsTheVerdictAsWideAsItOnceHadToBe) {
    give(kVerdict, {.usual = kVerdictSample, .isOpen = true, .whole = 26});
    makeWide(300);
    const char* words = "10.0 % lost, network, over";
    addRow("Good", "60.0");
    m_model.item(0, kVerdict)->setText(words);
    EXPECT_GE(m_table.columnWidth(kVerdict), widthOf(words));
    m_model.item(0, kVerdict)->setText("Good");
    EXPECT_GE(m_table.columnWidth(kVerdict), widthOf(words));
}

TEST_F(FittingHeaderTest, GivesRoomThatIsLeftToNamesFirst) {
    makeWide(2000);
    EXPECT_GE(m_table.columnWidth(kName), widthOf("A performer's name that is long"));
    EXPECT_FALSE(m_table.isColumnHidden(kAge));
    EXPECT_EQ(m_table.columns().length(), m_table.viewport()->width());
}

} // namespace
} // namespace posewire::gui
