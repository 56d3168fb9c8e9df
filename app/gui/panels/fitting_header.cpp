// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/fitting_header.h"

#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/plain_text.h"

#include <QAbstractButton>
#include <QJsonArray>
#include <QMenu>
#include <QScopedValueRollback>

#include <algorithm>

namespace posewire::gui {

namespace {

/// The style sheet pads titles by 6 pixels at either side.
constexpr int kTitleSpace = 14;

} // namespace

FittingHeader::FittingHeader(QAbstractItemView* table, QFont (*cellFont)(), int room, Kept kept)
    : QHeaderView(Qt::Horizontal, table), m_table(table), m_font(cellFont), m_room(room), m_kept(kept) {
    setStretchLastSection(false);
    setMinimumSectionSize(0);
    setHighlightSections(false);
    setTextElideMode(Qt::ElideRight);
    setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    connect(this, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
        QMenu menu(this);
        addColumnActions(menu);
        menu.exec(mapToGlobal(at));
    });
}

void FittingHeader::setSamples(std::vector<QString> samples, const QString& leastOpen) {
    m_samples = std::move(samples);
    m_leastOpen = leastOpen;
    while (model() != nullptr && m_names.size() < columns()) {
        m_names += model()->headerData(static_cast<int>(m_names.size()), Qt::Horizontal).toString();
    }
    measure();
}

void FittingHeader::keepOpenFor(const QString& text) {
    if (textWidth(text) > leastOpenWidth()) {
        m_leastOpen = text;
        fit();
    }
}

void FittingHeader::keepFigures() {
    bool isWider = false;
    const QAbstractItemModel& rows = *model();
    for (int column = 0; column < columns(); ++column) {
        if (isSectionHidden(column) || column == openColumn() || isElastic(column) || !isOfFigures(column)) {
            continue;
        }
        QString& sample = m_samples[static_cast<std::size_t>(column)];
        for (int row = 0; row < rows.rowCount(); ++row) {
            const QString text = rows.data(rows.index(row, column), Qt::DisplayRole).toString();
            if (text.size() > sample.size() && textWidth(text) > sampleWidth(column)) {
                sample = text;
                isWider = true;
            }
        }
    }
    if (isWider) {
        measure();
    }
}

void FittingHeader::wishOpenFor(const QString& text) {
    m_wishedOpen = text;
    fit();
}

void FittingHeader::setUseful(int column, bool isUseful) {
    if (m_useless.contains(column) == isUseful) {
        isUseful ? static_cast<void>(m_useless.removeAll(column)) : m_useless.append(column);
        measure();
    }
}

void FittingHeader::setGivingWay(std::vector<int> columns) {
    m_givingWay = std::move(columns);
    setContextMenuPolicy(Qt::CustomContextMenu);
    measure();
}

void FittingHeader::addElastic(int column, const QString& least, const QString& most, const QString& soon) {
    std::erase_if(m_elastic, [column](const Elastic& one) { return one.column == column; });
    m_elastic.push_back({column, least, most, soon});
    measure();
}

void FittingHeader::keepElasticFor(int column, const QString& text) {
    const auto elastic = std::ranges::find(m_elastic, column, &Elastic::column);
    if (elastic != m_elastic.end() && textWidth(text) > soonWidth(column)) {
        elastic->soon = text;
        fit();
    }
}

void FittingHeader::setUsual(std::vector<int> columns) {
    m_usual = std::move(columns);
    measure();
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
    for (const QString& name : m_names) {
        if (columns.contains(name)) {
            m_chosen += name;
        }
    }
    measure();
}

QJsonObject FittingHeader::state() const {
    return m_chosen.isEmpty() ? QJsonObject()
                              : QJsonObject{{"columns", QJsonArray::fromStringList(m_chosen)}};
}

int FittingHeader::openColumn() const {
    const auto open = std::ranges::find(m_samples, QString());
    return open == m_samples.end() ? -1 : static_cast<int>(open - m_samples.begin());
}

int FittingHeader::textWidth(const QString& text) const {
    const int margins = 2 * CellDelegate::margin(m_table->fontMetrics()) + m_room;
    return QFontMetrics(m_font()).horizontalAdvance(text) + margins;
}

int FittingHeader::sampleWidth(int column) const {
    const QString title = model()->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
    const int titleWidth = isHidden() ? 0 : m_table->fontMetrics().horizontalAdvance(title) + kTitleSpace;
    return std::max(textWidth(m_samples[static_cast<std::size_t>(column)]), titleWidth);
}

int FittingHeader::soonWidth(int column) const {
    const auto elastic = std::ranges::find(m_elastic, column, &Elastic::column);
    const bool isSoon = elastic != m_elastic.end() && !elastic->soon.isEmpty();
    return isSoon ? textWidth(elastic->soon) : sampleWidth(column);
}

int FittingHeader::leastOpenWidth() const {
    return m_leastOpen.isEmpty() ? m_table->fontMetrics().averageCharWidth() * 22 : textWidth(m_leastOpen);
}

bool FittingHeader::isWanted(int column) const {
    const int kept = m_kept == Kept::First ? 0 : openColumn();
    if (!m_chosen.isEmpty()) {
        return column == kept || m_chosen.contains(m_names[column]);
    }
    const bool isUsual = m_usual.empty() || std::ranges::find(m_usual, column) != m_usual.end();
    return column == kept || (isUsual && !m_useless.contains(column));
}

bool FittingHeader::isElastic(int column) const {
    return std::ranges::find(m_elastic, column, &Elastic::column) != m_elastic.end();
}

bool FittingHeader::isOfFigures(int column) const {
    return model()->headerData(column, Qt::Horizontal, Qt::TextAlignmentRole).isValid();
}

void FittingHeader::measure() {
    if (model() == nullptr || m_isFitting) {
        return; // sections that change their size ask for this again
    }
    {
        const QScopedValueRollback guard(m_isFitting, true);
        for (int column = 0; column < columns(); ++column) {
            // What fit() sizes is not sized twice: scroll bars would come and go, and begin all over.
            if (column != openColumn() && !isElastic(column)) {
                resizeSection(column, sampleWidth(column));
            }
        }
    }
    fit();
}

void FittingHeader::fit() {
    const int open = openColumn();
    if (model() == nullptr || open < 0 || m_isFitting) {
        return;
    }
    {
        const QScopedValueRollback guard(m_isFitting, true);
        shareOut(open);
    }
    emit fitted();
}

void FittingHeader::shareOut(int open) {
    const int width = m_table->viewport()->width();
    std::vector<bool> isShown;
    int needed = leastOpenWidth();
    for (int column = 0; column < columns(); ++column) {
        isShown.push_back(isWanted(column));
        needed += isShown.back() && column != open ? soonWidth(column) : 0;
    }
    for (const int column : m_givingWay) {
        const auto place = static_cast<std::size_t>(column);
        if (m_chosen.isEmpty() && needed > width && isShown[place] && column != open) {
            isShown[place] = false;
            needed -= soonWidth(column);
        }
    }
    for (int column = 0; column < columns(); ++column) {
        if (isSectionHidden(column) == isShown[static_cast<std::size_t>(column)]) {
            setSectionHidden(column, !isSectionHidden(column));
        }
    }
    for (const Elastic& one : m_elastic) {
        const bool isThere = isShown[static_cast<std::size_t>(one.column)];
        needed += isThere ? sampleWidth(one.column) - soonWidth(one.column) : 0;
    }
    const int spare = width - needed;
    const int wished = std::max(0, textWidth(m_wishedOpen) - leastOpenWidth());
    fitElastic(spare > 0 ? std::max(0, spare - wished) : spare);
    const int others = length() - sectionSize(open);
    // One that is kept for what it says gets narrower before all of it is scrolled away.
    const int least = m_kept == Kept::Open ? textWidth(QStringLiteral("123456")) : leastOpenWidth();
    resizeSection(open, std::max(least, width - others));
}

/// `spare` is what is left of the width, less than 0 where it is too small.
void FittingHeader::fitElastic(int spare) {
    for (const Elastic& one : m_elastic) {
        if (!isSectionHidden(one.column)) {
            const int usual = sampleWidth(one.column);
            const int fitting = std::clamp(usual + spare, textWidth(one.least), textWidth(one.most));
            resizeSection(one.column, fitting);
            spare -= fitting - usual;
        }
    }
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
    QAction* fitting =
        menu.addAction(m_usual.empty() ? tr("As many columns as fit") : tr("The usual columns"));
    fitting->setCheckable(true);
    fitting->setChecked(m_chosen.isEmpty());
    connect(fitting, &QAction::triggered, this, [this] { setChosen({}); });
    menu.addSeparator();
    for (int column = m_kept == Kept::First ? 1 : 0; column < columns(); ++column) {
        QAction* action = menu.addAction(model()->headerData(column, Qt::Horizontal).toString());
        action->setToolTip(
            toolTipText(model()->headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString()));
        action->setCheckable(true);
        action->setChecked(!isSectionHidden(column));
        action->setEnabled(m_kept == Kept::First || column != openColumn());
        connect(action, &QAction::toggled, this, [this, column](bool isShown) { choose(column, isShown); });
    }
    menu.setToolTipsVisible(true);
}

void FittingHeader::choose(int column, bool isShown) {
    QStringList chosen;
    for (int each = 0; each < columns(); ++each) {
        if (each == column ? isShown : !isSectionHidden(each)) {
            chosen += m_names[each];
        }
    }
    setChosen(chosen);
}

} // namespace posewire::gui
