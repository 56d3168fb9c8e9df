// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/texts.h"

#include "app/gui/help/markdown_view.h"
#include "app/gui/models/receiving_models.h"
#include "app/gui/models/statistics_model.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/plain_text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "app/gui/window/menus.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QKeySequence>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QScrollBar>
#include <QShortcut>
#include <QSysInfo>
#include <QTextDocument>
#include <QTextStream>
#include <QToolButton>
#include <QVBoxLayout>
#include <QtMath>

#include <algorithm>
#include <memory>

namespace posewire::gui {

namespace {

constexpr int kPlaceRole = Qt::UserRole;
constexpr int kDeepestListed = 2; ///< headings below that are not in the contents

QToolButton* arrow(Qt::ArrowType type, const QString& toolTip, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setArrowType(type);
    button->setToolTip(toolTipText(toolTip));
    button->setAccessibleName(toolTip);
    button->setProperty("flat", true);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

/// Room for the whole text in lines that can be read, and for a part of it where that is long.
QSize sizeOf(const QTextBrowser& browser) {
    const QFontMetrics metrics = browser.fontMetrics();
    const qreal most = metrics.averageCharWidth() * 100;
    const std::unique_ptr<QTextDocument> copy(browser.document()->clone());
    copy->setTextWidth(most);
    const qreal width = std::min(most, copy->idealWidth());
    copy->setTextWidth(width);
    const qreal height = std::min<qreal>(copy->size().height(), metrics.lineSpacing() * 40);
    const int scrollBar = browser.verticalScrollBar()->sizeHint().width();
    return {qCeil(width) + 2 * scrollBar, qCeil(height) + 3 * metrics.lineSpacing() / 2};
}

QString plainText(const char* words) {
    return QCoreApplication::translate("Action", words).remove(QLatin1Char('&'));
}

void writeReceiving(QTextStream& out, const ReceivingState& receiving) {
    for (const PortState& port : receiving.ports) {
        out << displayText(port.port) << ": " << inputState(port).text << ", " << port.status.datagrams
            << " datagrams, " << port.status.kernelDropped << " dropped here, "
            << port.status.refusedDatagrams << " refused\n";
    }
    for (const RelayState& relay : receiving.relays) {
        out << "relay to " << displayText(relay.target) << ": " << relayStage(relay).text << ", "
            << relay.sent << " sent, " << relay.refused << " refused, " << relay.skipped << " skipped, "
            << relay.behind << " behind\n";
    }
    for (const net::Finding& finding : receiving.findings) {
        out << "found: " << QString::fromStdString(finding.text) << '\n';
    }
    out << "receive buffer " << receiving.receiveBufferBytes << " bytes, dropped here "
        << receiving.kernelDropped << ", " << receiving.datagramsPerSecond << " datagrams/s, "
        << receiving.bytesPerSecond << " bytes/s\n";
}

void writeSenders(QTextStream& out, model::SessionView& session) {
    for (const model::Sender& sender : session.senders()) {
        out << "sender " << shown(sender.address()) << ": " << sender.datagrams << " datagrams, "
            << sender.malformed << " malformed, " << sender.foreign << " foreign, " << sender.skippedBytes
            << " bytes skipped\n";
    }
    for (const model::Stream& stream : session.streams()) {
        const model::CharacterKey key{stream.key.sender, stream.key.character};
        out << "stream " << shown(session.displayName(key)) << " type " << stream.key.type << ": "
            << stream.accounting.datagrams() << " datagrams, " << stream.statistics.rateHz() << " Hz, "
            << stream.accounting.counts().lost << " lost, " << stream.accounting.malformed()
            << " malformed\n";
    }
}

/// A window with text to read, in Markdown; deletes itself when closed.
void showText(const QString& title, const QString& markdown, QWidget& parent) {
    auto* dialog = new QDialog(&parent);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(title);
    auto* browser = new MarkdownView(dialog);
    browser->showText(markdown);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, dialog);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    auto* column = new QVBoxLayout(dialog);
    column->addWidget(browser);
    column->addWidget(buttons);
    dialog->resize(dialog->sizeHint() - browser->sizeHint() + sizeOf(*browser));
    dialog->show();
}

/// All keys of the menus.
QString shortcutsMarkdown() {
    QString text = tr("| Key | Menu | What it does |\n|---|---|---|\n");
    for (const MenuEntry& entry : menuEntries()) {
        const ActionInfo& info = *entry.action;
        const QKeySequence keys(QLatin1String(info.shortcut), QKeySequence::PortableText);
        if (!keys.isEmpty()) {
            text += QStringLiteral("| %1 | %2 | %3 |\n")
                        .arg(keys.toString(QKeySequence::NativeText),
                             plainText(info.menu).replace(QLatin1Char('/'), QStringLiteral(" > ")),
                             plainText(info.text));
        }
    }
    return text;
}

/// The columns of the statistics, in their order and in the words of their tooltips.
QString figuresMarkdown() {
    QString text = tr("| Column | What it says |\n|---|---|\n");
    for (int column = kNameColumn + 1; column < kStatisticsColumns; ++column) {
        if (const auto figure = figureIn(column)) {
            const model::FigureRow& row = model::rowOf(*figure);
            text += QStringLiteral("| %1 | %2 |\n").arg(tr(row.shortTitle()), tr(row.help));
        } else {
            text +=
                tr("| Curve | Rate over the range, or over the last two minutes; marked where samples were "
                   "lost |\n");
        }
    }
    return text;
}

} // namespace

ReferenceWindow::ReferenceWindow(const QString& title, const QString& markdown, QWidget* parent)
    : QDialog(parent),
      m_browser(new MarkdownView(this)),
      m_contents(new QListWidget(this)),
      m_search(new QLineEdit(this)),
      m_found(plainLabel(this)) {
    setAttribute(Qt::WA_DeleteOnClose);
    setWindowTitle(title);
    setWindowFlag(Qt::WindowMaximizeButtonHint);
    m_browser->setAccessibleName(title);
    m_browser->showText(markdown);
    m_contents->setAccessibleName(tr("Contents"));
    m_search->setPlaceholderText(tr("Find in the reference"));
    m_search->setClearButtonEnabled(true);
    listHeadings();
    layOut();
    connect(m_contents, &QListWidget::currentItemChanged, this, [this](const QListWidgetItem* item) {
        if (item != nullptr) {
            m_browser->showPlace(item->data(kPlaceRole).toInt());
        }
    });
    connect(m_browser, &QTextBrowser::anchorClicked, m_browser,
            [this](const QUrl& url) { m_browser->goTo(url.fragment()); });
    connect(m_search, &QLineEdit::textChanged, this, &ReferenceWindow::search);
    m_browser->setFocus();
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

void ReferenceWindow::listHeadings() {
    for (const MarkdownView::Heading& heading : m_browser->headings()) {
        if (heading.level == kDeepestListed) {
            auto* item = new QListWidgetItem(heading.text, m_contents);
            item->setData(kPlaceRole, heading.position);
        }
    }
    const int margin = m_contents->fontMetrics().averageCharWidth() * 4;
    m_contents->setFixedWidth(m_contents->sizeHintForColumn(0) + margin);
}

void ReferenceWindow::search(const QString& text) {
    const qsizetype count = m_browser->countOf(text);
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

bool ReferenceWindow::goTo(const QString& anchor) {
    return m_browser->goTo(anchor);
}

bool ReferenceWindow::find(bool isBackward) {
    return m_browser->findAgain(m_search->text(), isBackward);
}

QTextBrowser& ReferenceWindow::browser() const {
    return *m_browser;
}

QMap<QString, QString> madeHelpParts() {
    return {{QStringLiteral("shortcuts"), shortcutsMarkdown()},
            {QStringLiteral("figures"), figuresMarkdown()}};
}

void showAbout(QWidget& parent) {
    const QString text =
        tr("# Posewire %1\n\nNetwork monitor for MVN motion-capture streams.\n\n"
           "The application is free software under the GNU General Public License, version 3 "
           "or later; its core and renderer are under the MIT licence.\n\nQt %2\n")
            .arg(QCoreApplication::applicationVersion(), QLatin1String(qVersion()));
    showText(tr("About Posewire"), text, parent);
}

QString diagnosticsText(model::SessionView& session, const ReceivingState& receiving,
                        const QString& rendererName) {
    QString text;
    QTextStream out(&text);
    out << "Posewire " << QCoreApplication::applicationVersion() << ", Qt " << qVersion() << ", "
        << QSysInfo::prettyProductName() << ", " << QSysInfo::currentCpuArchitecture() << ", platform "
        << QGuiApplication::platformName() << '\n';
    out << "OpenGL: " << (rendererName.isEmpty() ? QStringLiteral("none") : rendererName) << '\n';
    writeReceiving(out, receiving);
    const log::LogFigures figures = session.log().figures();
    out << "history: packets " << figures.begin << " to " << figures.end << ", " << figures.memoryInUse
        << " of " << figures.memoryCap << " bytes\n";
    writeSenders(out, session);
    return text;
}

} // namespace posewire::gui
