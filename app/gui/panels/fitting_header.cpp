// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/fitting_header.h"

#include "app/gui/models/column.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/theme.h"

#include <QAbstractButton>
#include <QGuiApplication>
#include <QJsonArray>
#include <QMenu>
#include <QScopedValueRollback>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace posewire::gui {

/// A column's part of the width, in pixels.
struct FittingHeader::Share {
    int floor; ///< of the one that takes the room left, if the least of all is too much
    int least;
    int usual;
    int wish;
    int order;
    bool isOpen;
    bool isShown;
    int width = 0;
};

namespace {

using Share = FittingHeader::Share;

/// The style sheet pads titles by 6 pixels at either side.
constexpr int kTitleSpace = 14;

int widthOf(const std::vector<Share>& shares, int Share::*width) {
    return std::accumulate(shares.begin(), shares.end(), 0, [width](int sum, const Share& one) {
        return sum + (one.isShown ? one.*width : 0);
    });
}

void leaveInOrder(std::vector<Share>& shares, int room) {
    std::vector<Share*> leaving;
    for (Share& one : shares) {
        if (one.isShown && one.order > 0) {
            leaving.push_back(&one);
        }
    }
    std::ranges::stable_sort(leaving, {}, [](const Share* one) { return one->order; });
    for (auto next = leaving.begin(); next != leaving.end() && widthOf(shares, &Share::usual) > room;
         ++next) {
        (*next)->isShown = false;
    }
}

/// What takes the room left gets what it wishes before others do, and those from the right.
void shareOut(std::vector<Share>& shares, int room) {
    const auto open = std::find_if(shares.rbegin(), shares.rend(),
                                   [](const Share& one) { return one.isOpen && one.isShown; });
    const int needed = widthOf(shares, &Share::usual);
    const int slack = needed - widthOf(shares, &Share::least);
    const double cut = slack == 0 ? 0 : std::clamp((needed - room) / static_cast<double>(slack), 0.0, 1.0);
    int spare = std::max(0, room - needed);
    if (open != shares.rend()) {
        spare = std::max(0, spare - (open->wish - open->usual));
    }
    for (auto one = shares.rbegin(); one != shares.rend(); ++one) {
        const int more = one->isShown && one != open ? std::clamp(one->wish - one->usual, 0, spare) : 0;
        spare -= more;
        one->width = one->usual + more - static_cast<int>(std::ceil(cut * (one->usual - one->least)));
    }
    if (open != shares.rend()) {
        open->width = std::max(open->floor, room - (widthOf(shares, &Share::width) - open->width));
    }
}

} // namespace

FittingHeader::FittingHeader(QAbstractItemView* table, QFont (*cellFont)(), int space, Kept kept)
    : QHeaderView(Qt::Horizontal, table), m_table(table), m_font(cellFont), m_space(space), m_kept(kept) {
    table->installEventFilter(this);
    table->viewport()->installEventFilter(this);
    setStretchLastSection(false);
    setMinimumSectionSize(0);
    setHighlightSections(false);
    setTextElideMode(Qt::ElideRight);
    setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    connect(this, &QHeaderView::sectionResized, this, [this](int column, int /*before*/, int width) {
        // A new style resizes all sections, too.
        if (!m_isFitting && QGuiApplication::mouseButtons() != Qt::NoButton) {
            m_dragged[column] = width;
        }
    });
    connect(this, &QHeaderView::sectionCountChanged, this,
            [this](int /*before*/, int count) { m_whole.resize(static_cast<std::size_t>(count)); });
    connect(this, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
        QMenu menu(this);
        addColumnActions(menu);
        menu.exec(mapToGlobal(at));
    });
}

void FittingHeader::setModel(QAbstractItemModel* model) {
    {
        const QScopedValueRollback guard(m_isFitting, true);
        QHeaderView::setModel(model);
    }
    m_names.clear();
    m_dragged.clear();
    m_whole.assign(static_cast<std::size_t>(count()), {});
    if (model == nullptr) {
        return;
    }
    for (int column = 0; column < count(); ++column) {
        m_names += model->headerData(column, Qt::Horizontal).toString();
    }
    setContextMenuPolicy(isChoosable() ? Qt::CustomContextMenu : Qt::DefaultContextMenu);
    connect(model, &QAbstractItemModel::headerDataChanged, this,
            [this](Qt::Orientation /*orientation*/, int first, int last) {
                std::fill(m_whole.begin() + first, m_whole.begin() + last + 1, QString());
                fit();
            });
    connect(model, &QAbstractItemModel::modelReset, this, &FittingHeader::fit);
    fit();
}

/// The width or the font of the table may be another one.
bool FittingHeader::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize || event->type() == QEvent::FontChange ||
        event->type() == QEvent::StyleChange) {
        fit();
    }
    return QHeaderView::eventFilter(watched, event);
}

void FittingHeader::restore(const QJsonObject& state) {
    QStringList columns;
    for (const auto& column : state["columns"].toArray()) {
        columns += column.toString();
    }
    setChosen(columns);
}

void FittingHeader::setChosen(const QStringList& columns) {
    m_chosen.clear();
    std::ranges::copy_if(m_names, std::back_inserter(m_chosen),
                         [&](const QString& name) { return columns.contains(name); });
    fit();
}

QJsonObject FittingHeader::state() const {
    return m_chosen.isEmpty() ? QJsonObject()
                              : QJsonObject{{"columns", QJsonArray::fromStringList(m_chosen)}};
}

ColumnRoom FittingHeader::room(int column) const {
    return model()->headerData(column, Qt::Horizontal, kRoomRole).value<ColumnRoom>();
}

bool FittingHeader::isChoosable() const {
    for (int column = 0; column < count(); ++column) {
        if (room(column).order != 0) {
            return true;
        }
    }
    return false;
}

int FittingHeader::textWidth(const QString& text) const {
    const int margins = 2 * CellDelegate::margin(m_table->fontMetrics()) + m_space;
    return QFontMetrics(m_font()).horizontalAdvance(text) + margins;
}

int FittingHeader::usualWidth(int column, const QString& usual) const {
    const QString title = model()->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
    const int titleWidth = isHidden() ? 0 : m_table->fontMetrics().horizontalAdvance(title) + kTitleSpace;
    const QString& whole = m_whole[static_cast<std::size_t>(column)];
    return std::max({textWidth(usual), titleWidth, whole.isEmpty() ? 0 : textWidth(whole)});
}

FittingHeader::Share FittingHeader::share(int column) const {
    const ColumnRoom given = room(column);
    if (const auto dragged = m_dragged.find(column); dragged != m_dragged.end() && !given.isOpen) {
        const int width = dragged->second;
        return {width, width, width, width, given.order, false, isWanted(column)};
    }
    const int usual = usualWidth(column, given.usual);
    const int least = given.least.isEmpty() ? usual : std::min(usual, textWidth(given.least));
    // Words get narrower before part of the table is scrolled away.
    const int words = given.whole != 0 ? std::min(least, textWidth(given.usual)) : least;
    const int floor = m_kept == Kept::Open ? textWidth(QStringLiteral("123456")) : words;
    const int wish = given.wish.isEmpty() ? usual : std::max(usual, textWidth(given.wish));
    return {floor, least, usual, wish, given.order, given.isOpen, isWanted(column)};
}

bool FittingHeader::isWanted(int column) const {
    const bool isChosen =
        m_chosen.isEmpty() ? room(column).order != ColumnRoom::kOnChoice : m_chosen.contains(m_names[column]);
    return isChosen || isKept(column);
}

bool FittingHeader::isKept(int column) const {
    return m_kept == Kept::First ? column == 0 : room(column).isOpen;
}

bool FittingHeader::isOfFigures(int column) const {
    return model()->headerData(column, Qt::Horizontal, Qt::TextAlignmentRole).isValid();
}

void FittingHeader::fit() {
    if (model() == nullptr || m_isFitting) {
        return; // sections that change their size ask for this again
    }
    std::vector<Share> shares;
    for (int column = 0; column < count(); ++column) {
        shares.push_back(share(column));
    }
    if (std::ranges::none_of(shares, &Share::isOpen)) {
        return;
    }
    {
        const QScopedValueRollback guard(m_isFitting, true);
        const int width = m_table->viewport()->width();
        if (m_chosen.isEmpty()) {
            leaveInOrder(shares, width);
        }
        shareOut(shares, width);
        m_isBare =
            std::ranges::none_of(shares, [](const Share& one) { return one.isShown && one.order > 0; });
        for (int column = 0; column < count(); ++column) {
            const Share& one = shares[static_cast<std::size_t>(column)];
            if (isSectionHidden(column) == one.isShown) {
                setSectionHidden(column, !one.isShown);
            }
            if (one.isShown) {
                resizeSection(column, one.width);
            }
        }
    }
    emit fitted();
}

void FittingHeader::keepWhole() {
    if (model() == nullptr) {
        return;
    }
    for (int y = 1; y < m_table->viewport()->height();) {
        const QModelIndex row = m_table->indexAt(QPoint(1, y));
        if (!row.isValid()) {
            return;
        }
        keepWhole(row);
        y = std::max(y, m_table->visualRect(row).bottom()) + 1;
    }
}

void FittingHeader::keepWhole(const QModelIndex& row) {
    bool isWider = false;
    for (int column = 0; column < count(); ++column) {
        if (isSectionHidden(column)) {
            continue;
        }
        const QString text = growing(row.siblingAtColumn(column));
        QString& whole = m_whole[static_cast<std::size_t>(column)];
        if (text.size() > whole.size() && textWidth(text) > usualWidth(column, room(column).usual)) {
            whole = text;
            isWider = true;
        }
    }
    if (isWider) {
        fit();
    }
}

/// What a cell says that its column has to be wide enough for; empty where it may be cut.
QString FittingHeader::growing(const QModelIndex& cell) const {
    const ColumnRoom given = room(cell.column());
    if (given.whole == 0) {
        const bool isWhole = isOfFigures(cell.column()) && !given.isOpen && given.least.isEmpty();
        return isWhole ? cell.data().toString() : QString();
    }
    // While columns beside it say the rest, the short form is enough.
    const QVariant brief = cell.data(kShortTextRole);
    const QString words = (brief.isValid() && !m_isBare ? brief : cell.data()).toString().left(given.whole);
    const QString suffix = brief.isValid() ? QString() : cell.data(kSuffixRole).toString();
    const auto letter = std::ranges::find_if(given.usual, [](QChar one) { return one.isLetterOrNumber(); });
    const bool isIndented = given.usual.startsWith(QLatin1Char(' '));
    const QString before = isIndented ? given.usual.left(letter - given.usual.begin()) : QString();
    return before + (suffix.isEmpty() ? words : words + QLatin1Char(' ') + suffix);
}

int FittingHeader::titlesEnd() const {
    const int last = logicalIndexAt(std::min(width(), length() - offset()) - 1);
    if (last < 0) {
        return 0;
    }
    const int left = sectionViewportPosition(last);
    const QString title = model()->headerData(last, Qt::Horizontal, Qt::DisplayRole).toString();
    return isOfFigures(last)
               ? left + sectionSize(last)
               : left + std::min(sectionSize(last), fontMetrics().horizontalAdvance(title) + kTitleSpace);
}

bool FittingHeader::seat(QAbstractButton& button, const QStringList& words) const {
    const int room = width() - titlesEnd();
    const auto fits = [&](const QString& text) {
        button.setText(text);
        button.resize(button.sizeHint().width(), height() - 2);
        return button.width() < room;
    };
    const bool isSeated = std::ranges::any_of(words, fits) || fits(words.front());
    button.move(geometry().right() - button.width(), y());
    button.raise();
    return isSeated;
}

int FittingHeader::columnBeside(int column, int direction) const {
    for (int beside = column + direction; beside >= 0 && beside < count(); beside += direction) {
        if (!isSectionHidden(beside)) {
            return beside;
        }
    }
    return column;
}

void FittingHeader::addColumnActions(QMenu& menu) {
    QAction* fitting = menu.addAction(tr("The usual columns, as they fit"));
    fitting->setCheckable(true);
    fitting->setChecked(m_chosen.isEmpty());
    connect(fitting, &QAction::triggered, this, [this] { setChosen({}); });
    menu.addSeparator();
    for (int column = m_kept == Kept::First ? 1 : 0; column < count(); ++column) {
        QAction* action = menu.addAction(model()->headerData(column, Qt::Horizontal).toString());
        action->setToolTip(
            toolTipText(model()->headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString()));
        action->setCheckable(true);
        action->setChecked(!isSectionHidden(column));
        action->setEnabled(!isKept(column));
        connect(action, &QAction::toggled, this, [this, column](bool isShown) { choose(column, isShown); });
    }
    menu.setToolTipsVisible(true);
}

void FittingHeader::choose(int column, bool isShown) {
    QStringList chosen;
    for (int each = 0; each < count(); ++each) {
        if (each == column ? isShown : !isSectionHidden(each)) {
            chosen += m_names[each];
        }
    }
    setChosen(chosen);
}

} // namespace posewire::gui
