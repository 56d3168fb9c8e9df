// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/inputs_page.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/words.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QItemSelectionModel>
#include <QKeyEvent>
#include <QLabel>
#include <QShortcut>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <iterator>

namespace posewire::gui {

namespace {

constexpr int kTableRows = 6;
/// More addresses than this help nobody.
constexpr std::size_t kMostHosts = 4;
constexpr int kFirstHostRow = 3;

QLabel* valueLabel(QWidget* parent) {
    auto* label = plainLabel(parent);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    label->setFont(monospaceFont());
    return label;
}

} // namespace

std::vector<net::LocalAddress> hostsFor(const InputAddress& input,
                                        const std::vector<net::LocalAddress>& addresses) {
    std::vector<net::LocalAddress> hosts;
    if (input.kind == net::InputKind::TcpConnection) {
        return hosts;
    }
    for (const QString& group : input.groups) {
        hosts.push_back({group.toStdString(), "", true, false, false});
    }
    if (!hosts.empty()) {
        return hosts;
    }
    if (input.address.isEmpty()) {
        const bool hasOther =
            std::ranges::any_of(addresses, [](const net::LocalAddress& each) { return !each.isLinkLocal; });
        std::ranges::copy_if(addresses, std::back_inserter(hosts),
                             [&](const net::LocalAddress& each) { return !hasOther || !each.isLinkLocal; });
        hosts.resize(std::min(hosts.size(), kMostHosts));
        return hosts;
    }
    const std::string own = input.address.toStdString();
    const auto known = std::ranges::find(addresses, own, &net::LocalAddress::address);
    return {known == addresses.end() ? net::LocalAddress{own, "", true, false, false} : *known};
}

/// What to type into MVN so that it reaches an input: host, port and protocol, in MVN's words, to be copied.
class SenderSettings final : public QWidget {
public:
    explicit SenderSettings(QWidget* parent)
        : QWidget(parent), m_port(valueLabel(this)), m_protocol(valueLabel(this)) {
        m_title->setWordWrap(true);
        m_grid->setContentsMargins(0, 0, 0, 0);
        m_grid->setHorizontalSpacing(fontMetrics().height());
        m_grid->setColumnStretch(3, 1);
        m_grid->addWidget(m_title, 0, 0, 1, 4);
        m_grid->addWidget(dimLabel(tr("Protocol"), this), 1, 0);
        m_grid->addWidget(m_protocol, 1, 1);
        m_grid->addWidget(dimLabel(tr("Port"), this), 2, 0);
        m_grid->addWidget(m_port, 2, 1);
        m_grid->addWidget(dimLabel(tr("Host"), this), kFirstHostRow, 0);
    }

    void showFor(const InputAddress& input, const std::vector<net::LocalAddress>& addresses) {
        const bool isOutgoing = input.kind == net::InputKind::TcpConnection;
        m_title->setText(
            isOutgoing ? tr("This input connects to %1, which has to listen there. There is nothing to "
                            "enter in MVN: it makes connections itself, and needs an input that listens.")
                             .arg(input.address)
                       : tr("Enter in MVN, under Options > Preferences > Network Streamer:"));
        for (QLabel* label : findChildren<QLabel*>(QString(), Qt::FindDirectChildrenOnly)) {
            label->setVisible(label == m_title || !isOutgoing);
        }
        setHosts(hostsFor(input, addresses));
        m_port->setText(QString::number(input.port));
        m_protocol->setText(input.kind == InputAddress::Kind::Udp ? tr("UDP") : tr("TCP"));
    }

private:
    struct HostRow {
        QLabel* host;
        QLabel* interface;
        QToolButton* copy;
    };

    void setHosts(const std::vector<net::LocalAddress>& hosts) {
        while (m_rows.size() < hosts.size()) {
            const int row = kFirstHostRow + static_cast<int>(m_rows.size());
            HostRow widgets{valueLabel(this), dimLabel({}, this), framedButton(tr("Copy"), {}, this)};
            m_grid->addWidget(widgets.host, row, 1);
            m_grid->addWidget(widgets.copy, row, 2);
            m_grid->addWidget(widgets.interface, row, 3);
            connect(widgets.copy, &QToolButton::clicked, this,
                    [host = widgets.host] { copyText(host->text()); });
            m_rows.push_back(widgets);
        }
        for (std::size_t i = 0; i < m_rows.size(); ++i) {
            const bool isShown = i < hosts.size();
            for (QWidget* widget :
                 std::initializer_list<QWidget*>{m_rows[i].host, m_rows[i].interface, m_rows[i].copy}) {
                widget->setVisible(isShown);
            }
            if (isShown) {
                const QString host = QString::fromStdString(hosts[i].address);
                if (host != m_rows[i].host->text()) {
                    m_rows[i].host->setText(host);
                    m_rows[i].copy->setAccessibleName(tr("Copy %1").arg(host));
                }
                m_rows[i].interface->setText(QString::fromStdString(hosts[i].interface));
            }
        }
    }

    QGridLayout* m_grid = new QGridLayout(this);
    QLabel* m_title = plainLabel(this);
    QLabel* m_port;
    QLabel* m_protocol;
    std::vector<HostRow> m_rows;
};

InputsPage::InputsPage(Receiving& receiving, QWidget* parent)
    : QWidget(parent), m_receiving(receiving), m_settings(new SenderSettings(this)) {
    m_table->setModel(&m_model);
    m_table->setEmptyText(tr("There are no inputs. Add one below: by default MVN sends to UDP port 9763."));
    layOut();
    setFocusProxy(m_table);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentChanged, this, &InputsPage::showChoice);
    connect(m_table, &QAbstractItemView::activated, this, &InputsPage::editSelected);
    connect(m_edit, &QPushButton::clicked, this, &InputsPage::editSelected);
    connect(m_remove, &QPushButton::clicked, this, &InputsPage::removeSelected);
    connect(m_openFile, &QPushButton::clicked, this, &InputsPage::openFileRequested);
    connect(m_form, &InputForm::submitted, this, &InputsPage::submit);
    connect(m_submit, &QPushButton::clicked, this, &InputsPage::submit);
    connect(m_cancel, &QPushButton::clicked, this, &InputsPage::endEditing);
    new QShortcut(QKeySequence::Delete, m_table, this, &InputsPage::removeSelected, Qt::WidgetShortcut);
    m_allowed->setText(m_receiving.allowed().join(QStringLiteral(", ")));
    connect(m_allowed, &QLineEdit::editingFinished, this, &InputsPage::applyAllowed);
    connect(m_allowed, &QLineEdit::textEdited, this, [this] {
        m_allowedProblem.clear();
        showAllowedNote();
    });
    endEditing();
    refresh();
}

void InputsPage::layOut() {
    m_table->setMinimumHeight(m_table->heightForRows(kTableRows));
    m_state->setObjectName(QStringLiteral("inputState"));
    m_state->setWordWrap(true);
    m_state->setMinimumHeight(2 * fontMetrics().lineSpacing());
    m_state->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(m_edit);
    buttons->addWidget(m_remove);
    buttons->addWidget(m_undo);
    buttons->addSpacing(fontMetrics().height());
    buttons->addWidget(m_state, 1);
    buttons->addWidget(m_openFile);
    auto* formRow = new QHBoxLayout;
    auto* submitColumn = new QVBoxLayout;
    submitColumn->addSpacing(fontMetrics().height() + 6); // beside the fields, not their labels
    submitColumn->addWidget(m_submit);
    submitColumn->addWidget(m_cancel);
    submitColumn->addStretch(1);
    formRow->addWidget(m_form, 1);
    formRow->addLayout(submitColumn);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height() * 2 / 3);
    column->addWidget(m_table, 1);
    column->addLayout(buttons);
    column->addWidget(new Line(this));
    column->addLayout(formRow);
    column->addWidget(new Line(this));
    auto* allowedLabel = plainLabel(tr("&Listen only to"), this);
    allowedLabel->setBuddy(m_allowed);
    m_allowed->setPlaceholderText(tr("everyone"));
    auto* allowed = new QGridLayout;
    allowed->addWidget(allowedLabel, 0, 0);
    allowed->addWidget(m_allowed, 0, 1);
    allowed->addWidget(m_allowedNote, 1, 1);
    column->addLayout(allowed);
    column->addWidget(new Line(this));
    column->addWidget(m_settings);
}

/// Enter in the table has edited a row already: the dialog is not to press a button besides.
void InputsPage::keyPressEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) {
        QWidget::keyPressEvent(event);
    }
}

void InputsPage::applyAllowed() {
    const auto allowed = parseAllowed(m_allowed->text());
    m_allowedProblem = allowed ? QString() : allowed.error();
    if (allowed && *allowed != m_receiving.allowed()) {
        m_receiving.listenTo(*allowed);
        emit choicesChanged();
    }
    showAllowedNote();
}

/// What is wrong with what is typed, else with whose name is looked up, else what the field is for.
void InputsPage::showAllowedNote() {
    const ReceivingState& state = m_receiving.state();
    const QString problem = m_allowedProblem.isEmpty() ? state.allowedProblem : m_allowedProblem;
    const QString refused = m_receiving.allowed().isEmpty() && state.refusedDatagrams == 0
                                ? QString()
                                : tr(" %1 datagrams of others so far.").arg(grouped(state.refusedDatagrams));
    if (problem.isEmpty()) {
        m_allowedNote->explain(tr("Hosts or nets, such as 192.168.1.0/24, for all inputs; others are only "
                                  "counted. Empty for everyone.") +
                               refused);
    } else {
        m_allowedNote->warn(problem);
    }
}

void InputsPage::refresh() {
    m_model.refresh(m_receiving.state());
    showAllowedNote();
    if (!m_table->currentIndex().isValid() && m_model.rowCount() > 0) {
        m_table->setCurrentIndex(m_model.index(0, 0));
    }
    showChoice();
}

std::optional<InputAddress> InputsPage::selected() const {
    return m_model.input(m_table->currentIndex().row());
}

void InputsPage::showChoice() {
    const auto input = selected();
    m_edit->setEnabled(input.has_value());
    m_remove->setEnabled(input.has_value());
    const QModelIndex state = m_table->currentIndex().siblingAtColumn(InputModel::kState);
    const QVariant colour = state.data(Qt::ForegroundRole);
    setTextColour(*m_state, colour.isValid() ? colour.value<QColor>() : theme().text);
    m_state->setText(state.data().toString());
    m_settings->showFor(input.value_or(InputAddress{}), m_receiving.state().addresses);
}

void InputsPage::select(const InputAddress& input) {
    if (const int row = m_model.rowOf(input); row >= 0) {
        m_table->setCurrentIndex(m_model.index(row, 0));
    }
}

void InputsPage::submit() {
    const auto input = readInput(m_form->typed());
    if (!input) {
        m_form->setProblem(input.error());
        return;
    }
    const QString problem =
        m_edited ? m_receiving.changePort(*m_edited, *input) : m_receiving.tryPort(*input);
    if (!problem.isEmpty()) {
        m_form->setProblem(problem);
        refresh();
        return;
    }
    endEditing();
    refresh();
    select(*input);
    emit choicesChanged();
}

void InputsPage::editSelected() {
    if (const auto input = selected()) {
        m_edited = input;
        m_form->setInput(*input);
        m_submit->setText(tr("&Apply"));
        m_cancel->setVisible(true);
        m_form->focusHost();
    }
}

void InputsPage::endEditing() {
    m_edited.reset();
    m_form->setInput({});
    m_submit->setText(tr("&Add input"));
    m_cancel->setVisible(false);
}

void InputsPage::removeSelected() {
    const auto input = selected();
    if (!input) {
        return;
    }
    const int row = m_model.rowOf(*input);
    m_undo->carryOut(
        displayText(*input), [this, input = *input] { remove(input); },
        [this, input = *input, row] { putBack(input, row); });
}

void InputsPage::remove(const InputAddress& input) {
    if (m_edited == input) {
        endEditing();
    }
    m_receiving.removePort(input);
    refresh();
    emit choicesChanged();
}

void InputsPage::putBack(const InputAddress& input, int row) {
    m_receiving.addPort(input, static_cast<std::size_t>(row));
    refresh();
    select(input);
    emit choicesChanged();
}

} // namespace posewire::gui
