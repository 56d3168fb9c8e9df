// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/reference_window.h"

#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"
#include "app/gui/window/texts.h"
#include "core/export/protocol_reference.h"

#include <QAbstractTextDocumentLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QScrollBar>
#include <QShortcut>
#include <QTextBlock>
#include <QToolButton>
#include <QVBoxLayout>

namespace posewire::gui {

namespace {

constexpr int kPlaceRole = Qt::UserRole;
constexpr int kDeepestListed = 2; ///< headings below that are not in the contents

QToolButton* arrow(Qt::ArrowType type, const QString& toolTip, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setArrowType(type);
    button->setToolTip(toolTip);
    button->setAccessibleName(toolTip);
    button->setProperty("flat", true);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

} // namespace

ReferenceWindow::ReferenceWindow(const QString& title, const QString& markdown, QWidget* parent)
    : QDialog(parent),
      m_browser(new QTextBrowser(this)),
      m_contents(new QListWidget(this)),
      m_search(new QLineEdit(this)),
      m_found(new QLabel(this)) {
    setAttribute(Qt::WA_DeleteOnClose);
    setWindowTitle(title);
    setWindowFlag(Qt::WindowMaximizeButtonHint);
    m_browser->setFrameShape(QFrame::NoFrame);
    m_browser->setAccessibleName(title);
    m_browser->setOpenLinks(false);
    m_browser->setMarkdown(markdown);
    m_contents->setAccessibleName(tr("Contents"));
    m_search->setPlaceholderText(tr("Find in the reference"));
    m_search->setClearButtonEnabled(true);
    layOut();
    readHeadings();
    applyColours();
    connect(m_contents, &QListWidget::currentItemChanged, this, [this](const QListWidgetItem* item) {
        if (item != nullptr) {
            showPlace(item->data(kPlaceRole).toInt());
        }
    });
    connect(m_browser, &QTextBrowser::anchorClicked, this, [this](const QUrl& url) { goTo(url.fragment()); });
    connect(m_search, &QLineEdit::textChanged, this, &ReferenceWindow::search);
    m_browser->setFocus();
    new EventWatch(this, QEvent::PaletteChange, [this] { applyColours(); });
}

void ReferenceWindow::layOut() {
    auto* next = arrow(Qt::DownArrow, tr("Next place (Enter, F3)"), this);
    auto* previous = arrow(Qt::UpArrow, tr("Place before (Shift+Enter, Shift+F3)"), this);
    connect(next, &QToolButton::clicked, this, [this] { find(false); });
    connect(previous, &QToolButton::clicked, this, [this] { find(true); });
    const auto onKey = [this](const QKeySequence& keys, auto&& action) {
        connect(new QShortcut(keys, this), &QShortcut::activated, this, action);
    };
    onKey(QKeySequence::Find, [this] {
        m_search->setFocus();
        m_search->selectAll();
    });
    onKey(QKeySequence(Qt::Key_F3), [this] { find(false); });
    onKey(QKeySequence(Qt::SHIFT | Qt::Key_F3), [this] { find(true); });
    onKey(QKeySequence(Qt::SHIFT | Qt::Key_Return), [this] { find(true); });
    connect(m_search, &QLineEdit::returnPressed, this, [this] { find(false); });

    const QFontMetrics metrics = fontMetrics();
    m_contents->setFrameShape(QFrame::NoFrame);
    auto* bar = new QHBoxLayout;
    bar->setSpacing(6);
    bar->addWidget(m_search);
    bar->addWidget(previous);
    bar->addWidget(next);
    bar->addWidget(m_found, 1);
    m_search->setFixedWidth(metrics.averageCharWidth() * 30);
    auto* right = new QVBoxLayout;
    right->addLayout(bar);
    right->addWidget(m_browser, 1);
    auto* row = new QHBoxLayout(this);
    row->addWidget(m_contents);
    row->addLayout(right, 1);
    resize(metrics.averageCharWidth() * 165, metrics.lineSpacing() * 48);
}

void ReferenceWindow::readHeadings() {
    for (QTextBlock block = m_browser->document()->begin(); block.isValid(); block = block.next()) {
        const int level = block.blockFormat().headingLevel();
        if (level == 0) {
            continue;
        }
        m_places.insert(QString::fromStdString(exporting::headingAnchor(block.text().toStdString())),
                        block.position());
        if (level == kDeepestListed) {
            auto* item = new QListWidgetItem(block.text(), m_contents);
            item->setData(kPlaceRole, block.position());
        }
    }
    const int margin = m_contents->fontMetrics().averageCharWidth() * 4;
    m_contents->setFixedWidth(m_contents->sizeHintForColumn(0) + margin);
}

void ReferenceWindow::applyColours() {
    QTextDocument& document = *m_browser->document();
    QTextCursor cursor(&document);
    cursor.beginEditBlock();
    styleTables(document);
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        if (block.blockFormat().headingLevel() != 0) {
            QTextBlockFormat format;
            format.setTopMargin(fontMetrics().height());
            format.setBottomMargin(fontMetrics().height() / 3.0);
            cursor.setPosition(block.position());
            cursor.mergeBlockFormat(format);
        }
        for (auto at = block.begin(); !at.atEnd(); ++at) {
            const QTextFragment fragment = at.fragment();
            if (fragment.charFormat().isAnchor()) {
                cursor.setPosition(fragment.position());
                cursor.setPosition(fragment.position() + fragment.length(), QTextCursor::KeepAnchor);
                QTextCharFormat format;
                format.setForeground(theme().accent);
                format.setFontUnderline(false);
                cursor.mergeCharFormat(format);
            }
        }
    }
    cursor.endEditBlock();
}

bool ReferenceWindow::goTo(const QString& anchor) {
    const auto place = m_places.constFind(anchor);
    if (place == m_places.cend()) {
        return false;
    }
    showPlace(*place);
    return true;
}

void ReferenceWindow::showPlace(int position) {
    QTextDocument& document = *m_browser->document();
    const QRectF block = document.documentLayout()->blockBoundingRect(document.findBlock(position));
    m_browser->verticalScrollBar()->setValue(static_cast<int>(block.top()));
    QTextCursor cursor(&document);
    cursor.setPosition(position);
    m_browser->setTextCursor(cursor);
    m_browser->verticalScrollBar()->setValue(static_cast<int>(block.top()));
}

void ReferenceWindow::search(const QString& text) {
    const qsizetype count =
        text.isEmpty() ? 0 : m_browser->document()->toPlainText().count(text, Qt::CaseInsensitive);
    QString found = count == 1 ? tr("1 place") : tr("%1 places").arg(count);
    if (count == 0) {
        found = text.isEmpty() ? QString() : tr("not found");
    }
    m_found->setText(found);
    QTextCursor cursor = m_browser->textCursor();
    cursor.setPosition(cursor.selectionStart());
    m_browser->setTextCursor(cursor);
    find(false);
}

bool ReferenceWindow::find(bool isBackward) {
    const QString text = m_search->text();
    if (text.isEmpty()) {
        return false;
    }
    const auto flags = isBackward ? QTextDocument::FindBackward : QTextDocument::FindFlags();
    if (m_browser->find(text, flags)) {
        return true;
    }
    const QTextCursor before = m_browser->textCursor();
    m_browser->moveCursor(isBackward ? QTextCursor::End : QTextCursor::Start);
    const bool isFound = m_browser->find(text, flags);
    if (!isFound) {
        m_browser->setTextCursor(before);
    }
    return isFound;
}

} // namespace posewire::gui
