// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/relay_page.h"

#include <QHBoxLayout>
#include <QHostAddress>
#include <QItemSelectionModel>
#include <QKeyEvent>
#include <QShortcut>
#include <QVBoxLayout>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kTargetRows = 6;

/// "::1" has colons of its own: the port of an IPv6 address follows brackets.
bool isBareAddress(const QString& text) {
    return text.count(QLatin1Char(':')) != 1 && !text.startsWith(QLatin1Char('['));
}

} // namespace

tl::expected<RelayChoice, QString> readRelay(const QString& text) {
    const QString trimmed = text.trimmed();
    if (trimmed.isEmpty() || trimmed.contains(QLatin1Char(' '))) {
        return tl::unexpected(RelayPage::tr("Type a host, or host:port."));
    }
    if (isBareAddress(trimmed)) {
        return trimmed.contains(QLatin1Char(':')) && QHostAddress(trimmed).isNull()
                   ? tl::expected<RelayChoice, QString>(
                         tl::unexpected(RelayPage::tr("'%1' is not an address.").arg(trimmed)))
                   : RelayChoice{trimmed};
    }
    const auto input = parseInputAddress(trimmed, InputAddress::Kind::TcpConnection);
    if (!input) {
        return tl::unexpected(
            RelayPage::tr("'%1' is not host:port with a port from 1 to 65535.").arg(trimmed));
    }
    return RelayChoice{input->address, input->port};
}

RelayPage::RelayPage(Relaying& relaying, QWidget* parent) : QWidget(parent), m_relaying(relaying) {
    m_table->setModel(&m_model);
    m_table->setEmptyText(tr("Nothing is forwarded. Add the host of another program that needs the stream."));
    layOut();
    setFocusProxy(m_target);
    connect(&m_model, &RelayModel::switched, this, &RelayPage::switchTarget, Qt::QueuedConnection);
    connect(m_add, &QPushButton::clicked, this, &RelayPage::submit);
    connect(m_remove, &QPushButton::clicked, this, &RelayPage::removeSelected);
    connect(m_target, &QLineEdit::textChanged, this, [this] { setProblem({}); });
    connect(m_table->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this](const QModelIndex& current) {
                m_remove->setEnabled(current.isValid());
                showNote();
            });
    new QShortcut(QKeySequence::Delete, m_table, this, &RelayPage::removeSelected, Qt::WidgetShortcut);
    setProblem({});
    refresh();
}

void RelayPage::layOut() {
    auto* about = dimText(tr("Every received datagram is forwarded by UDP, unchanged, to each target that "
                             "is on. Receiving never waits for this. Files are not forwarded."),
                          this);
    m_table->setMinimumHeight(m_table->heightForRows(kTargetRows));
    m_target->setPlaceholderText(tr("host:port, such as 192.168.1.40:%1").arg(kDefaultPort));
    m_remove->setEnabled(false);
    auto* label = plainLabel(tr("&Target"), this);
    label->setBuddy(m_target);
    auto* row = new QHBoxLayout;
    row->addWidget(label);
    row->addWidget(m_target, 1);
    row->addWidget(m_add);
    row->addSpacing(fontMetrics().height());
    row->addWidget(m_remove);
    row->addWidget(m_undo);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height() * 2 / 3);
    column->addWidget(about);
    column->addWidget(m_table, 1);
    column->addLayout(row);
    column->addWidget(m_note);
}

void RelayPage::refresh() {
    m_model.refresh(m_relaying.states());
    m_remove->setEnabled(m_table->currentIndex().isValid());
    showNote();
}

void RelayPage::submit() {
    const auto choice = readRelay(m_target->text());
    if (!choice) {
        setProblem(choice.error());
        return;
    }
    if (!m_relaying.add(*choice)) {
        setProblem(tr("%1 is already in the list.").arg(displayText(*choice)));
        return;
    }
    m_target->clear();
    refresh();
    m_table->setCurrentIndex(m_model.index(m_model.rowCount() - 1, 0));
    emit choicesChanged();
}

void RelayPage::removeSelected() {
    const QModelIndex current = m_table->currentIndex();
    if (!current.isValid()) {
        return;
    }
    const auto row = static_cast<std::size_t>(current.row());
    const RelayChoice choice = m_relaying.states()[row].target;
    m_undo->carryOut(
        displayText(choice), [this, choice] { remove(choice); },
        [this, choice, row] { putBack(choice, row); });
}

void RelayPage::remove(const RelayChoice& choice) {
    const auto& states = m_relaying.states();
    const auto found = std::ranges::find_if(states, [&](const RelayState& state) {
        return state.target.host == choice.host && state.target.port == choice.port;
    });
    if (found != states.end()) {
        m_relaying.remove(static_cast<std::size_t>(found - states.begin()));
        refresh();
        emit choicesChanged();
    }
}

void RelayPage::putBack(const RelayChoice& choice, std::size_t row) {
    if (m_relaying.add(choice, row)) {
        refresh();
        m_table->setCurrentIndex(m_model.index(static_cast<int>(row), 0));
        emit choicesChanged();
    }
}

void RelayPage::switchTarget(int row, bool isOn) {
    if (static_cast<std::size_t>(row) < m_relaying.states().size()) {
        m_relaying.setOn(static_cast<std::size_t>(row), isOn);
        refresh();
        emit choicesChanged();
    }
}

void RelayPage::setProblem(const QString& problem) {
    m_problem = problem;
    showNote();
}

/// What is wrong with what is typed, else with the selected target: the table has no room for sentences.
void RelayPage::showNote() {
    if (m_problem.isEmpty()) {
        m_note->explain(m_table->currentIndex().siblingAtColumn(RelayModel::kState).data().toString());
    } else {
        m_note->warn(m_problem);
    }
}

void RelayPage::keyPressEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) {
        QWidget::keyPressEvent(event);
    } else if (m_target->hasFocus()) {
        submit();
    }
}

} // namespace posewire::gui
