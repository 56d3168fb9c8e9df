// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/cell_delegate.h"

#include "app/gui/models/column.h"
#include "app/gui/panels/table_view.h"

#include <QApplication>
#include <QHeaderView>
#include <QImage>
#include <QScreen>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <QTreeView>

#include <gtest/gtest.h>

#include <random>

namespace posewire::gui {
namespace {

class CellDelegateTest : public testing::Test {
protected:
    CellDelegateTest() {
        m_view.setModel(&m_model);
        m_view.setItemDelegate(&m_delegate);
        m_view.setRootIsDecorated(false);
        m_view.resize(300, 80);
    }

    /// Colours that are seen within a cell.
    int coloursIn(const QStringList& row, int column) {
        m_model.clear();
        QList<QStandardItem*> items;
        for (const QString& text : row) {
            items += new QStandardItem(text);
        }
        m_model.appendRow(items);
        for (int each = 0; each < m_model.columnCount(); ++each) {
            m_view.setColumnWidth(each, 90);
            m_view.setColumnHidden(each, each == m_hidden);
        }
        const QRect cell = m_view.visualRect(m_model.index(0, column));
        const QImage image = m_view.viewport()->grab(cell.adjusted(2, 2, -2, -2)).toImage();
        QSet<QRgb> colours;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                colours.insert(image.pixel(x, y));
            }
        }
        return static_cast<int>(colours.size());
    }

    QStandardItemModel m_model;
    QTreeView m_view;
    int m_hidden = -1;
    CellDelegate m_delegate{&m_view};
};

const QString kLong = QStringLiteral("4 datagrams could not be decoded");

TEST_F(CellDelegateTest, WordsRunOnOverEmptyCells) {
    EXPECT_EQ(coloursIn({QStringLiteral("4"), {}, QStringLiteral("x")}, 1), 1) << "they fit";
    EXPECT_GT(coloursIn({kLong, {}, QStringLiteral("x")}, 1), 1);
    EXPECT_GT(coloursIn({kLong, {}, {}}, 2), 1) << "over all that are empty";
    EXPECT_EQ(coloursIn({kLong, QStringLiteral("x"), {}}, 2), 1) << "but not beyond others";
}

TEST_F(CellDelegateTest, WordsRunOnPastAColumnThatIsHidden) {
    m_hidden = 1;
    EXPECT_GT(coloursIn({kLong, {}, {}}, 2), 1);
}

/// A table of words and numbers, any of which may be empty, as wide as a narrow dock.
class ChangingTableTest : public testing::Test {
protected:
    static constexpr int kRows = 5;
    static constexpr int kColumns = 6;

    ChangingTableTest() {
        for (const int column : {1, 3, 4}) {
            for (int row = 0; row < kRows; ++row) {
                m_model.setData(m_model.index(row, column), Qt::AlignRight, Qt::TextAlignmentRole);
            }
        }
        for (int column = 0; column < kColumns; ++column) { // one of the numbers may be cut
            const ColumnRoom room{.usual = column == 3 ? "12" : "1234567", .isOpen = column == 3};
            m_model.setHeaderData(column, Qt::Horizontal, QVariant::fromValue(room), kRoomRole);
        }
        m_table.setModel(&m_model);
        m_table.resize(330, 200);
        m_table.show();
    }
    void changeCells(int count) {
        const QStringList words{{}, "4", kLong, "no data", {}};
        const QStringList numbers{{}, "7", "12 345", "123 456 789", "0.3"};
        const QSignalBlocker silent(m_model);
        for (int i = 0; i < count; ++i) {
            const QModelIndex cell = m_model.index(upTo(kRows), upTo(kColumns));
            m_model.setData(cell, (CellDelegate::isNumber(cell) ? numbers : words)[upTo(5)]);
            m_model.setData(cell, upTo(9) == 0 ? QVariant(QColor(Qt::red)) : QVariant(), Qt::ForegroundRole);
            m_model.setData(cell, upTo(9) == 0 ? QVariant(QStringLiteral("· 12")) : QVariant(), kSuffixRole);
        }
    }
    void announce() { emit m_model.dataChanged(m_model.index(0, 0), m_model.index(kRows - 1, kColumns - 1)); }
    [[nodiscard]] QImage picture() {
        QApplication::processEvents();
        return m_table.screen()->grabWindow(m_table.winId()).toImage();
    }
    int upTo(int end) { return static_cast<int>(m_random() % static_cast<unsigned>(end)); }

    std::minstd_rand m_random;
    QStandardItemModel m_model{kRows, kColumns};
    TableView m_table{"Changing"};
};

TEST_F(ChangingTableTest, ShowsWhatAPictureOfAllOfItShows) {
    for (int step = 0; step < 300; ++step) {
        changeCells(1 + step % 4);
        announce();
        const QImage shown = picture();
        m_table.viewport()->update();
        ASSERT_EQ(shown, picture()) << step;
    }
}

TEST_F(ChangingTableTest, PaintsACellThatChangedAlone) {
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            m_model.setData(m_model.index(row, column), column);
        }
    }
    static_cast<void>(picture());
    const QModelIndex cell = m_model.index(2, 3);
    {
        const QSignalBlocker silent(m_model);
        m_model.setData(cell, 9);
    }
    auto& cells = static_cast<CellDelegate&>(*m_table.itemDelegate());
    EXPECT_EQ(cells.takeStale(m_table), QRegion(m_table.visualRect(cell)));
    EXPECT_TRUE(cells.takeStale(m_table).isEmpty());
}

} // namespace
} // namespace posewire::gui
