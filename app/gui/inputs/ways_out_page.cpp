// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/ways_out_page.h"

#include "app/gui/theme/words.h"
#include "app/outlets/outlet.h"

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

tl::expected<WayOut, QString> readTarget(const QString& text) {
    const QString trimmed = text.trimmed();
    if (trimmed.isEmpty() || trimmed.contains(QLatin1Char(' '))) {
        return tl::unexpected(WaysOutPage::tr("Type a host, or host:port."));
    }
    if (isBareAddress(trimmed)) {
        return trimmed.contains(QLatin1Char(':')) && QHostAddress(trimmed).isNull()
                   ? tl::expected<WayOut, QString>(
                         tl::unexpected(WaysOutPage::tr("'%1' is not an address.").arg(trimmed)))
                   : WayOut{trimmed};
    }
    const auto input = parseInputAddress(trimmed, InputAddress::Kind::TcpConnection);
    if (!input) {
        return tl::unexpected(
            WaysOutPage::tr("'%1' is not host:port with a port from 1 to 65535.").arg(trimmed));
    }
    return WayOut{input->address, input->port};
}

WaysOutPage::WaysOutPage(WaysOut& waysOut, QWidget* parent) : QWidget(parent), m_waysOut(waysOut) {
    m_table->setModel(&m_model);
    m_table->setEmptyText(tr("Nothing is handed on. Add the host of another program that needs the stream."));
    layOut();
    setFocusProxy(m_target);
    connect(&m_model, &WaysOutModel::switched, this, &WaysOutPage::switchTarget, Qt::QueuedConnection);
    connect(m_add, &QPushButton::clicked, this, &WaysOutPage::submit);
    connect(m_remove, &QPushButton::clicked, this, &WaysOutPage::removeSelected);
    connect(m_target, &QLineEdit::textChanged, this, [this] { setProblem({}); });
    connect(m_kind, &QComboBox::currentIndexChanged, this, &WaysOutPage::showKind);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this](const QModelIndex& current) {
                m_remove->setEnabled(current.isValid());
                showNote();
            });
    new QShortcut(QKeySequence::Delete, m_table, this, &WaysOutPage::removeSelected, Qt::WidgetShortcut);
    showKind();
    refresh();
}

void WaysOutPage::showKind() {
    const outlets::OutletKind& kind =
        outlets::outletKinds()[static_cast<std::size_t>(m_kind->currentIndex())];
    m_character->setVisible(kind.isOfOne);
    m_kind->setToolTip(toolTipText(translatedText(kind.help)));
    m_target->setPlaceholderText(
        kind.place == "-"    ? tr("port of this computer alone, or address:port, such as 9800")
        : !kind.needsHost    ? tr("domain; %1 if left empty").arg(QString::fromUtf8(kind.place))
        : kind.place.empty() ? tr("host:port, such as 192.168.1.40:%1").arg(kDefaultPort)
                             : tr("host:port; %1 if left empty").arg(QString::fromUtf8(kind.place)));
    setProblem({});
}

tl::expected<WayOut, QString> WaysOutPage::read() const {
    const outlets::OutletKind& kind =
        outlets::outletKinds()[static_cast<std::size_t>(m_kind->currentIndex())];
    if (kind.place.empty()) {
        return readTarget(m_target->text());
    }
    const QString typed = m_target->text().trimmed();
    const bool isDefault = typed.isEmpty() && kind.place != "-";
    const std::string place = isDefault ? std::string(kind.place) : typed.toStdString();
    const auto target = kind.needsHost ? net::parseTarget(place) : net::parseEndpoint(place);
    if (!target) {
        return tl::unexpected(QString::fromStdString(target.error().text));
    }
    return WayOut{QString::fromStdString(target->host), target->port, true, QString::fromUtf8(kind.name),
                  kind.isOfOne ? m_character->text().trimmed() : QString()};
}

void WaysOutPage::layOut() {
    auto* about =
        dimText(tr("What is received is handed on to each target that is on. Receiving never waits for "
                   "this. Files are not handed on."),
                this);
    m_table->setMinimumHeight(m_table->heightForRows(kTargetRows));
    for (const outlets::OutletKind& kind : outlets::outletKinds()) {
        m_kind->addItem(translatedText(kind.title));
        m_kind->setItemData(m_kind->count() - 1, toolTipText(translatedText(kind.help)), Qt::ToolTipRole);
    }
    m_kind->setAccessibleName(tr("Form"));
    m_character->setPlaceholderText(tr("name or ID; else the first"));
    m_character->setAccessibleName(tr("Character"));
    m_remove->setEnabled(false);
    auto* label = plainLabel(tr("&to"), this);
    label->setBuddy(m_target);
    auto* row = new QHBoxLayout;
    row->addWidget(m_kind);
    row->addWidget(label);
    row->addWidget(m_target, 2);
    row->addWidget(m_character, 1);
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

void WaysOutPage::refresh() {
    m_model.refresh(m_waysOut.states());
    m_remove->setEnabled(m_table->currentIndex().isValid());
    showNote();
}

void WaysOutPage::submit() {
    const auto choice = read();
    if (!choice) {
        setProblem(choice.error());
        return;
    }
    if (!m_waysOut.add(*choice)) {
        setProblem(tr("%1 is already in the list.").arg(displayText(*choice)));
        return;
    }
    m_target->clear();
    refresh();
    m_table->setCurrentIndex(m_model.index(m_model.rowCount() - 1, 0));
    emit choicesChanged();
}

void WaysOutPage::removeSelected() {
    const QModelIndex current = m_table->currentIndex();
    if (!current.isValid()) {
        return;
    }
    const auto row = static_cast<std::size_t>(current.row());
    const WayOut choice = m_waysOut.states()[row].target;
    m_undo->carryOut(
        displayText(choice), [this, choice] { remove(choice); },
        [this, choice, row] { putBack(choice, row); });
}

void WaysOutPage::remove(const WayOut& choice) {
    const auto& states = m_waysOut.states();
    const auto found =
        std::ranges::find_if(states, [&](const WayOutState& state) { return state.target.isLike(choice); });
    if (found != states.end()) {
        m_waysOut.remove(static_cast<std::size_t>(found - states.begin()));
        refresh();
        emit choicesChanged();
    }
}

void WaysOutPage::putBack(const WayOut& choice, std::size_t row) {
    if (m_waysOut.add(choice, row)) {
        refresh();
        m_table->setCurrentIndex(m_model.index(static_cast<int>(row), 0));
        emit choicesChanged();
    }
}

void WaysOutPage::switchTarget(int row, bool isOn) {
    if (static_cast<std::size_t>(row) < m_waysOut.states().size()) {
        m_waysOut.setOn(static_cast<std::size_t>(row), isOn);
        refresh();
        emit choicesChanged();
    }
}

void WaysOutPage::setProblem(const QString& problem) {
    m_problem = problem;
    showNote();
}

/// Explains a mistake in the fields, else the state of the selected target: the table has no room for
/// sentences.
void WaysOutPage::showNote() {
    if (m_problem.isEmpty()) {
        m_note->explain(m_table->currentIndex().siblingAtColumn(WaysOutModel::kState).data().toString());
    } else {
        m_note->warn(m_problem);
    }
}

void WaysOutPage::keyPressEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) {
        QWidget::keyPressEvent(event);
    } else if (m_target->hasFocus() || m_character->hasFocus()) {
        submit();
    }
}

} // namespace posewire::gui
