// SPDX-License-Identifier: GPL-3.0-or-later
// What a FilterBar offers below its line: completions and filters used before.
#include "app/gui/models/column.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/filter_bar.h"
#include "app/gui/theme/theme.h"
#include "core/filter/completion.h"

#include <QAbstractItemView>
#include <QCompleter>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListView>
#include <QStandardItemModel>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kOffsetRole = Qt::UserRole + 20; ///< bytes of the UTF-8 text
constexpr int kLengthRole = Qt::UserRole + 21;
constexpr int kVisibleOffers = 10;
constexpr int kLongestLine = 90; ///< characters
constexpr std::size_t kMostOffers = 200;

QStandardItem* offerItem(const QString& text, const QString& about, qulonglong offset, qulonglong length) {
    auto* item = new QStandardItem(text);
    item->setData(about, kSuffixRole);
    item->setData(offset, kOffsetRole);
    item->setData(length, kLengthRole);
    return item;
}

} // namespace

void FilterBar::makeCompleter() {
    m_offers = new QStandardItemModel(this);
    m_completer = new QCompleter(m_offers, this);
    m_completer->setWidget(m_line);
    m_completer->setCompletionMode(QCompleter::UnfilteredPopupCompletion);
    m_completer->setMaxVisibleItems(kVisibleOffers);
    auto* list = new QListView;
    m_completer->setPopup(list);
    list->setItemDelegate(new CellDelegate(list));
    list->setUniformItemSizes(true);
    list->setProperty("popup", true);
    list->installEventFilter(this); // after the completer, so before it
    connect(m_completer, qOverload<const QModelIndex&>(&QCompleter::activated), this,
            &FilterBar::insertOffer);
}

void FilterBar::offerCompletions() {
    m_offers->clear();
    const QString whole = m_line->text();
    const QByteArray before = whole.left(m_line->cursorPosition()).toUtf8();
    auto found = filter::completions(whole.toStdString(), static_cast<std::size_t>(before.size()));
    found.resize(std::min(found.size(), kMostOffers));
    for (const filter::Completion& one : found) {
        m_offers->appendRow(offerItem(QString::fromStdString(one.text), QString::fromStdString(one.about),
                                      one.offset, one.length));
    }
    offer();
}

void FilterBar::offerHistory() {
    if (m_history.isEmpty()) {
        offerCompletions();
        return;
    }
    m_offers->clear();
    const auto length = static_cast<qulonglong>(m_line->text().toUtf8().size());
    for (const QString& text : m_history) {
        m_offers->appendRow(offerItem(text, {}, 0, length));
    }
    offer();
}

void FilterBar::offer() {
    if (m_offers->rowCount() == 0 || !m_line->hasFocus()) {
        hideOffers();
        return;
    }
    QAbstractItemView* list = m_completer->popup();
    list->setFont(monospaceFont());
    const int wanted = list->sizeHintForColumn(0) + 2 * m_line->fontMetrics().height();
    const int room =
        window()->mapToGlobal(window()->rect().topRight()).x() - m_line->mapToGlobal(QPoint(0, 0)).x();
    QRect place = m_line->rect();
    const int readable = QFontMetrics(list->font()).averageCharWidth() * kLongestLine;
    place.setWidth(std::max(place.width(), std::min({wanted, room, readable})));
    m_hasChosen = false;
    m_completer->complete(place);
}

void FilterBar::hideOffers() {
    m_completer->popup()->hide();
}

/// Tab takes what is chosen, or else the first.
void FilterBar::takeOffer() {
    const QModelIndex current = m_completer->popup()->currentIndex();
    hideOffers();
    insertOffer(current.isValid() ? current : m_offers->index(0, 0));
}

void FilterBar::insertOffer(const QModelIndex& offer) {
    QByteArray text = m_line->text().toUtf8();
    const auto offset = static_cast<qsizetype>(offer.data(kOffsetRole).toULongLong());
    const auto length = static_cast<qsizetype>(offer.data(kLengthRole).toULongLong());
    const QByteArray inserted = offer.data(Qt::DisplayRole).toString().toUtf8();
    text.replace(offset, length, inserted);
    m_line->setText(QString::fromUtf8(text));
    m_line->setCursorPosition(
        static_cast<int>(QString::fromUtf8(text.first(offset + inserted.size())).size()));
}

/// Keys while offers are in sight. Enter applies what was written, unless an offer was chosen by the arrows.
bool FilterBar::offersTake(int key) {
    if (key == Qt::Key_Tab) {
        takeOffer();
        return true;
    }
    if ((key == Qt::Key_Return || key == Qt::Key_Enter) && !m_hasChosen) {
        hideOffers();
        applyAndLeave();
        return true;
    }
    m_hasChosen |= key == Qt::Key_Up || key == Qt::Key_Down;
    return false;
}

bool FilterBar::eventFilter(QObject* watched, QEvent* event) {
    if (watched == m_completer->popup() && event->type() == QEvent::KeyPress) {
        return offersTake(static_cast<QKeyEvent*>(event)->key());
    }
    if (watched == m_line && event->type() == QEvent::KeyPress && !m_completer->popup()->isVisible()) {
        const auto* press = static_cast<QKeyEvent*>(event);
        const int key = press->key();
        if (key == Qt::Key_Down && press->modifiers().testFlag(Qt::AltModifier)) {
            offerHistory();
            return true;
        }
        if (key == Qt::Key_Escape || key == Qt::Key_Down) {
            emit left();
            return true;
        }
    }
    if (watched == m_line && event->type() == QEvent::FocusOut && !m_completer->popup()->isVisible()) {
        showError();
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace posewire::gui
