// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/fitting_header.h"

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
        m_table.setModel(&m_model);
        m_table.setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        m_table.setColumnSamples({"A performer's name", QString(), "1000.0", "99.9"}, kVerdictSample);
        m_table.columns().setGivingWay({kAge, kRate});
        m_table.columns().addElastic(kName, "A perf", "A performer's name that is long");
        m_table.show();
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
    m_table.columns().addElastic(kName, "A perf", "A performer's name that is long", "A perf");
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
    m_model.appendRow({new QStandardItem("Name"), new QStandardItem("good"), new QStandardItem("60.0"),
                       new QStandardItem("0.1")});
    makeWide(800);
    const int usual = m_table.columnWidth(kRate);
    m_table.columns().keepFigures();
    EXPECT_EQ(m_table.columnWidth(kRate), usual);
    m_model.item(0, kRate)->setText("10 062 457.0");
    m_table.columns().keepFigures();
    EXPECT_GE(m_table.columnWidth(kRate), widthOf("10 062 457.0"));
    m_model.item(0, kRate)->setText("1.0");
    m_table.columns().keepFigures();
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
    m_table.columns().wishOpenFor(words);
    EXPECT_GE(m_table.columnWidth(kVerdict), widthOf(words));
    EXPECT_GE(m_table.columnWidth(kName), widthOf("A performer's name"));
    makeWide(2000);
    EXPECT_GE(m_table.columnWidth(kName), widthOf("A performer's name that is long"));
}

TEST_F(FittingHeaderTest, KeepsTheVerdictAsWideAsItOnceHadToBe) {
    makeWide(300);
    const char* words = "10.0 % lost, network, over";
    m_table.columns().keepOpenFor(words);
    EXPECT_GE(m_table.columnWidth(kVerdict), widthOf(words));
    m_table.columns().keepOpenFor("Good");
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
