// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/find_bar.h"

#include "app/gui/models/packet_model.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"

#include <QKeyEvent>

namespace posewire::gui {

namespace {

constexpr int kBytes = 1; ///< of the kinds

} // namespace

FindBar::FindBar(QWidget* parent) : QWidget(parent) {
    m_kind->addItems({tr("Text"), tr("Bytes")});
    m_kind->setAccessibleName(tr("What to find"));
    m_edit->setAccessibleName(tr("Find in packets"));
    m_edit->setFont(monospaceFont());
    m_edit->setMaxLength(1024);
    m_edit->setAcceptDrops(false); // a file that is dropped on it is the window's
    QToolButton* previous = flatButton(QStringLiteral("↑"), tr("Find previous (Shift+F3)"), this);
    QToolButton* next = flatButton(QStringLiteral("↓"), tr("Find next (F3)"), this);
    QToolButton* hide = flatButton(QStringLiteral("×"), tr("Close (Esc)"), this);
    auto* row = spacedRow({8, 0, 8, 5}, 6, this);
    row->addWidget(m_kind);
    row->addWidget(m_edit, 3);
    row->addWidget(previous);
    row->addWidget(next);
    row->addWidget(m_answer, 2);
    row->addWidget(hide);
    m_answer->setMinimumWidth(fontMetrics().averageCharWidth() * 16);
    m_answer->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    connect(m_edit, &QLineEdit::returnPressed, this, [this] { emit findRequested(Direction::Forward); });
    connect(previous, &QToolButton::clicked, this, [this] { emit findRequested(Direction::Backward); });
    connect(next, &QToolButton::clicked, this, [this] { emit findRequested(Direction::Forward); });
    connect(hide, &QToolButton::clicked, this, &FindBar::close);
    connect(m_edit, &QLineEdit::textChanged, this, [this] { say({}, false); });
    connect(m_kind, &QComboBox::currentIndexChanged, this, &FindBar::showKind);
    connect(&m_poll, &QTimer::timeout, this, &FindBar::takeResult);
    m_poll.setInterval(20);
    showKind();
    QWidget::hide();
}

void FindBar::open() {
    show();
    m_edit->setFocus(Qt::ShortcutFocusReason);
    m_edit->selectAll();
}

void FindBar::close() {
    hide();
    emit closed();
}

void FindBar::find(const log::PacketLog& log, const PacketModel& list, std::uint64_t from,
                   Direction direction) {
    auto pattern = parsePattern(m_edit->text(), m_kind->currentIndex() == kBytes);
    if (m_edit->text().isEmpty() || !pattern) {
        open();
        if (!m_edit->text().isEmpty()) {
            say(pattern.error(), true);
        }
        return;
    }
    if (list.isFiltered() && list.matches().empty()) {
        say(tr("No packet is listed"), true);
        return;
    }
    m_search = std::make_unique<PacketSearch>(
        log, PacketSearch::Request{*std::move(pattern), from, direction == Direction::Forward,
                                   list.isFiltered() ? list.matches() : PacketNumbers()});
    say(tr("Searching …"), false);
    m_poll.start();
}

void FindBar::takeResult() {
    const auto result = m_search->result();
    if (!result) {
        return;
    }
    m_poll.stop();
    m_search.reset();
    if (!result->found) {
        say(result->gone == 0 ? tr("Not found")
                              : tr("Not found; %1 packets left memory before they were looked at")
                                    .arg(grouped(result->gone)),
            true);
        return;
    }
    emit found(*result->found);
    const QString place =
        tr("in packet %1, byte %2").arg(grouped(result->found->packet)).arg(result->found->begin);
    say(result->isWrapped ? tr("%1 (wrapped around)").arg(place) : place, false);
}

void FindBar::showKind() {
    m_edit->setPlaceholderText(m_kind->currentIndex() == kBytes ? QStringLiteral("4d 58 54 50")
                                                                : tr("text, such as a name"));
    say({}, false);
}

void FindBar::say(const QString& text, bool isProblem) {
    setTextColour(*m_answer, isProblem ? theme().error : theme().dim);
    m_answer->setText(isProblem ? healthText(Health::Error, text) : text);
    m_answer->setToolTip(toolTipText(text));
}

void FindBar::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape) {
        close();
        event->accept();
        return;
    }
    QWidget::keyPressEvent(event);
}

} // namespace posewire::gui
