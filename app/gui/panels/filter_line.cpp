// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/filter_line.h"

#include "app/gui/models/column.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QInputMethodEvent>
#include <QKeyEvent>
#include <QListView>
#include <QTextCharFormat>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kOffsetRole = Qt::UserRole + 20; ///< bytes of the UTF-8 text
constexpr int kLengthRole = Qt::UserRole + 21;
constexpr int kVisibleOffers = 10;
constexpr int kLongestLine = 90; ///< characters
constexpr std::size_t kMostOffers = 200;
constexpr qsizetype kHistory = 30;

/// Place in a text of a place in its UTF-8.
int placeOf(const QString& text, std::size_t byte) {
    return static_cast<int>(QString::fromUtf8(text.toUtf8().left(static_cast<qsizetype>(byte))).size());
}

} // namespace

LineLanguage filterLanguage() {
    return {[](const std::string& text) {
                const auto compiled = filter::Filter::compile(text);
                return compiled ? std::nullopt : std::optional(compiled.error());
            },
            filter::completions, FilterLine::tr("Press Enter to filter"),
            FilterLine::tr("Alt and arrow down: earlier filters")};
}

FilterLine::FilterLine(QLabel* problem, QWidget* parent, LineLanguage language)
    : QLineEdit(parent), m_language(std::move(language)), m_problem(problem) {
    setObjectName(QStringLiteral("displayFilter"));
    setAccessibleName(tr("Display filter"));
    setPlaceholderText(tr("Filter packets, such as type == 02 && gap > 0"));
    setClearButtonEnabled(true);
    setMaxLength(static_cast<int>(filter::Filter::kLongestText));
    setAcceptDrops(false); // a file that is dropped on it is the window's
    m_completer->setWidget(this);
    m_completer->setCompletionMode(QCompleter::UnfilteredPopupCompletion);
    m_completer->setMaxVisibleItems(kVisibleOffers);
    auto* list = new QListView;
    m_completer->setPopup(list);
    list->setItemDelegate(new CellDelegate(list));
    list->setUniformItemSizes(true);
    list->setProperty("popup", true);
    list->installEventFilter(this); // after the completer, so before it
    connect(m_completer, qOverload<const QModelIndex&>(&QCompleter::activated), this,
            &FilterLine::insertOffer);
    connect(this, &QLineEdit::textChanged, this, &FilterLine::compile);
    connect(this, &QLineEdit::textEdited, this, [this](const QString& text) {
        if (text.isEmpty()) {
            apply();
            m_completer->popup()->hide();
        } else {
            offerCompletions();
        }
    });
    connect(this, &QLineEdit::returnPressed, this, &FilterLine::applyAndLeave);
    restyle();
}

void FilterLine::setApplied(const QString& filter) {
    m_applied = filter;
    if (filter != this->filter()) {
        setText(filter);
        setCursorPosition(0); // of a long one the beginning says more
    }
    restyle();
}

void FilterLine::compile() {
    m_error = m_language.errorOf(filter().toStdString());
    restyle();
    if (!m_error || m_problem->isVisible()) {
        showError();
    }
    underline();
}

bool FilterLine::check() {
    compile();
    showError();
    return !m_error;
}

void FilterLine::showError() {
    m_problem->setVisible(m_error.has_value());
    m_problem->clear();
    if (m_error) {
        setTextColour(*m_problem, theme().error);
        m_problem->setText(healthText(Health::Error, QString::fromStdString(m_error->text)) +
                           tr(" (at character %1)").arg(placeOf(filter(), m_error->offset) + 1));
    }
}

/// A line edit draws formats where an input method asks for them.
void FilterLine::underline() {
    QList<QInputMethodEvent::Attribute> attributes;
    if (m_error) {
        const auto lead = static_cast<int>(text().indexOf(filter()));
        const int begin = lead + placeOf(filter(), m_error->offset);
        const int end = lead + placeOf(filter(), m_error->offset + std::max<std::size_t>(1, m_error->length));
        QTextCharFormat format;
        format.setUnderlineStyle(QTextCharFormat::WaveUnderline);
        format.setUnderlineColor(theme().error);
        attributes.append(
            {QInputMethodEvent::TextFormat, begin - cursorPosition(), std::max(1, end - begin), format});
    }
    QInputMethodEvent event({}, attributes);
    QCoreApplication::sendEvent(this, &event);
}

void FilterLine::restyle() {
    setFont(monospaceFont());
    const bool isApplied = filter() == m_applied;
    const QColor border = m_error              ? theme().error
                          : filter().isEmpty() ? theme().line
                          : isApplied          ? theme().good
                                               : theme().accent;
    const bool isTinted = m_error || (isApplied && !filter().isEmpty());
    setToolTip(toolTipText(m_error     ? QString::fromStdString(m_error->text)
                           : isApplied ? m_language.onHistory
                                       : m_language.onEnter));
    const QString sheet = QStringLiteral("QLineEdit { border: 1px solid %1; background: %2; }")
                              .arg(border.name(), (isTinted ? tinted(border) : theme().panel).name());
    if (styleSheet() != sheet) {
        setStyleSheet(sheet);
    }
}

void FilterLine::apply() {
    if (!check()) {
        return;
    }
    m_applied = filter();
    if (!m_applied.isEmpty()) {
        m_history.removeAll(m_applied);
        setHistory(QStringList(m_applied) + m_history);
    }
    restyle();
    emit applied(m_applied);
}

/// One that is wrong is to be put right: the keyboard stays.
void FilterLine::applyAndLeave() {
    apply();
    if (!m_error) {
        emit left();
    }
}

void FilterLine::setHistory(const QStringList& history) {
    m_history = history.first(std::min(kHistory, history.size()));
}

void FilterLine::offerCompletions() {
    m_offers->clear();
    const QByteArray before = text().left(cursorPosition()).toUtf8();
    auto found = m_language.completions(text().toStdString(), static_cast<std::size_t>(before.size()));
    found.resize(std::min(found.size(), kMostOffers));
    for (const filter::Completion& one : found) {
        addOffer(QString::fromStdString(one.text), QString::fromStdString(one.about), one.offset, one.length);
    }
    offer();
}

void FilterLine::offerHistory() {
    if (m_history.isEmpty()) {
        offerCompletions();
        return;
    }
    m_offers->clear();
    for (const QString& text : m_history) {
        addOffer(text, {}, 0, static_cast<std::size_t>(this->text().toUtf8().size()));
    }
    offer();
}

void FilterLine::addOffer(const QString& text, const QString& about, std::size_t offset, std::size_t length) {
    auto* item = new QStandardItem(text);
    item->setData(about, kSuffixRole);
    item->setData(qulonglong{offset}, kOffsetRole);
    item->setData(qulonglong{length}, kLengthRole);
    m_offers->appendRow(item);
}

void FilterLine::offer() {
    QAbstractItemView* list = m_completer->popup();
    if (m_offers->rowCount() == 0 || !hasFocus()) {
        list->hide();
        return;
    }
    list->setFont(monospaceFont());
    const int wanted = list->sizeHintForColumn(0) + 2 * fontMetrics().height();
    const int room = window()->mapToGlobal(window()->rect().topRight()).x() - mapToGlobal(QPoint(0, 0)).x();
    QRect place = rect();
    const int readable = QFontMetrics(list->font()).averageCharWidth() * kLongestLine;
    place.setWidth(std::max(place.width(), std::min({wanted, room, readable})));
    m_hasChosen = false;
    m_completer->complete(place);
}

void FilterLine::insertOffer(const QModelIndex& offer) {
    QByteArray bytes = text().toUtf8();
    const auto offset = static_cast<qsizetype>(offer.data(kOffsetRole).toULongLong());
    const auto length = static_cast<qsizetype>(offer.data(kLengthRole).toULongLong());
    const QByteArray inserted = offer.data(Qt::DisplayRole).toString().toUtf8();
    bytes.replace(offset, length, inserted);
    setText(QString::fromUtf8(bytes));
    setCursorPosition(static_cast<int>(QString::fromUtf8(bytes.first(offset + inserted.size())).size()));
}

/// Keys while offers are in sight. Tab takes what is chosen, or else the first. Enter applies what was
/// written, unless an offer was chosen by the arrows.
bool FilterLine::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) {
        return QLineEdit::eventFilter(watched, event);
    }
    QAbstractItemView* list = m_completer->popup();
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool isEnter = (key == Qt::Key_Return || key == Qt::Key_Enter) && !m_hasChosen;
    m_hasChosen |= key == Qt::Key_Up || key == Qt::Key_Down;
    if (key != Qt::Key_Tab && !isEnter) {
        return QLineEdit::eventFilter(watched, event);
    }
    const QModelIndex current = list->currentIndex();
    list->hide();
    if (isEnter) {
        applyAndLeave();
    } else {
        insertOffer(current.isValid() ? current : m_offers->index(0, 0));
    }
    return true;
}

void FilterLine::keyPressEvent(QKeyEvent* event) {
    const bool isDown = event->key() == Qt::Key_Down;
    if (m_completer->popup()->isVisible() || (!isDown && event->key() != Qt::Key_Escape)) {
        QLineEdit::keyPressEvent(event);
    } else if (isDown && event->modifiers().testFlag(Qt::AltModifier)) {
        offerHistory();
    } else {
        emit left();
    }
}

void FilterLine::focusOutEvent(QFocusEvent* event) {
    if (!m_completer->popup()->isVisible()) {
        showError();
    }
    QLineEdit::focusOutEvent(event);
}

void FilterLine::changeEvent(QEvent* event) {
    QLineEdit::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) {
        restyle();
        if (m_problem->isVisible()) {
            showError();
        }
    }
}

} // namespace posewire::gui
