// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/column.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

struct Fruit {
    QString name;
    int count = 0;
};

class FruitModel : public TableModel<Fruit> {
public:
    FruitModel()
        : TableModel(
              {{.title = "Fruit",
                .text = [](const Fruit& row) { return row.name; },
                .more = [](const Fruit&,
                           int role) { return role == kSuffixRole ? QVariant("· ripe") : QVariant(); }},
               {.title = "Count",
                .help = "How many there are",
                .isNumber = true,
                .text = [](const Fruit& row) { return QString("%1 000").arg(row.count); }},
               valueColumn(TableColumn<Fruit>{.title = "State"}, [](const Fruit& row) {
                   return row.count == 0 ? PropertyValue{"none left", Health::Warning, "Buy some"}
                                         : PropertyValue{"", Health::Good};
               })}) {}
    void show(std::vector<Fruit> rows) { setRows(std::move(rows)); }
};

class ColumnModelTest : public testing::Test {
protected:
    [[nodiscard]] QVariant cell(int row, int column, int role = Qt::DisplayRole) const {
        return m_model.index(row, column).data(role);
    }

    FruitModel m_model;
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(ColumnModelTest, CellsAreTheFunctionsOfTheirColumn) {
    m_model.show({{"plum", 3}, {"pear", 0}});
    EXPECT_EQ(cell(0, 0), "plum");
    EXPECT_EQ(cell(0, 0, kSuffixRole), QStringLiteral("· ripe"));
    EXPECT_EQ(cellText(m_model.index(0, 0)), QStringLiteral("plum · ripe"));
    EXPECT_EQ(cellText(m_model.index(0, 1)), "3 000");
    EXPECT_FALSE(cell(0, 0, Qt::TextAlignmentRole).isValid());
    EXPECT_EQ(cell(0, 1, Qt::TextAlignmentRole), numberAlignment());
    EXPECT_FALSE(cell(0, 1, Qt::ToolTipRole).isValid());
}

TEST_F(ColumnModelTest, AJudgementIsShapeColourAndWordsAndSpokenWithoutTheShape) {
    m_model.show({{"plum", 3}, {"pear", 0}});
    EXPECT_EQ(cell(0, 2), QStringLiteral("●"));
    EXPECT_EQ(cell(0, 2, Qt::AccessibleTextRole), "good");
    EXPECT_EQ(cell(1, 2), QStringLiteral("▲ none left"));
    EXPECT_EQ(cell(1, 2, Qt::AccessibleTextRole), "warning, none left");
    EXPECT_EQ(cell(1, 2, Qt::ToolTipRole), "Buy some");
    EXPECT_EQ(cell(1, 2, Qt::ForegroundRole).value<QColor>(), healthColour(Health::Warning));
}

TEST_F(ColumnModelTest, HeadersHaveTitleHelpAndTheAlignmentOfTheirCells) {
    EXPECT_EQ(m_model.columnCount(), 3);
    EXPECT_EQ(m_model.headerData(1, Qt::Horizontal, Qt::DisplayRole), "Count");
    EXPECT_EQ(m_model.headerData(1, Qt::Horizontal, Qt::ToolTipRole), "How many there are");
    EXPECT_EQ(m_model.headerData(1, Qt::Horizontal, Qt::TextAlignmentRole), numberAlignment());
    EXPECT_FALSE(m_model.headerData(0, Qt::Horizontal, Qt::ToolTipRole).isValid());
    EXPECT_FALSE(m_model.headerData(3, Qt::Horizontal, Qt::DisplayRole).isValid());
    EXPECT_FALSE(m_model.headerData(0, Qt::Vertical, Qt::DisplayRole).isValid());
}

TEST_F(ColumnModelTest, AnnouncesAtMostOneInsertionRemovalAndChange) {
    const QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    const QSignalSpy removed(&m_model, &QAbstractItemModel::rowsRemoved);
    const QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    m_model.show({{"plum", 3}, {"pear", 0}, {"fig", 1}});
    EXPECT_EQ(inserted.count(), 1);
    EXPECT_EQ(changed.count(), 1);
    m_model.show({{"fig", 1}});
    EXPECT_EQ(removed.count(), 1);
    EXPECT_EQ(changed.count(), 2);
    EXPECT_EQ(cell(0, 0), "fig");
    m_model.show({});
    EXPECT_EQ(removed.count(), 2);
    EXPECT_EQ(inserted.count(), 1);
    EXPECT_EQ(changed.count(), 2);
}

TEST_F(ColumnModelTest, CellsWithoutATooltipOfTheirOwnCanExplainTheirColumn) {
    const auto columns = withHelpInCells(std::vector<TableColumn<Fruit>>{
        {.title = "Fruit", .help = "What it is"},
        {.title = "Count", .help = "How many", .toolTip = [](const Fruit& row) { return row.name; }}});
    EXPECT_EQ(cellData(columns[0], Fruit{"plum"}, Qt::ToolTipRole), "What it is");
    EXPECT_EQ(cellData(columns[1], Fruit{"plum"}, Qt::ToolTipRole), "plum");
    EXPECT_EQ(cellData(columns[1], Fruit{}, Qt::ToolTipRole), "How many");
}

TEST(PropertyModel, ShowsEveryValueAsOfTheNewestRefresh) {
    int samples = 1;
    PropertyModel facts({{"Lost", [&samples] { return PropertyValue{QString::number(samples)}; }},
                         {"Lost again", [&samples] { return PropertyValue{QString::number(samples)}; }}});
    facts.refresh();
    samples = 2; // more comes before all is painted
    EXPECT_EQ(facts.index(0, 1).data().toString(), "1");
    EXPECT_EQ(facts.index(1, 1).data().toString(), "1");
    facts.refresh();
    EXPECT_EQ(facts.index(1, 1).data().toString(), "2");
}

} // namespace
} // namespace posewire::gui
