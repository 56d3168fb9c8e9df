// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/cell_delegate.h"

#include <QHeaderView>
#include <QImage>
#include <QStandardItemModel>
#include <QTreeView>

#include <gtest/gtest.h>

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

} // namespace
} // namespace posewire::gui
