// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/inputs_page.h"

#include "app/gui/theme/words.h"

#include <QGridLayout>
#include <QHostAddress>
#include <QKeyEvent>
#include <QLabel>
#include <QRegularExpression>

namespace posewire::gui {

namespace {

using Kind = InputAddress::Kind;

constexpr int kMostPort = 65'535;

QString explanation(Kind kind, bool hasHost) {
    if (hasHost && kind == Kind::Udp) {
        return tr("Only what is sent to this address of this computer is heard: for a computer with several "
                  "networks. Broadcasts and multicast may then not arrive.");
    }
    if (hasHost && kind == Kind::TcpListener) {
        return tr("MVN can connect to this address of this computer alone: for a computer with several "
                  "networks.");
    }
    switch (kind) {
    case Kind::Udp:
        return tr("MVN sends to this computer. Leave the host empty to listen on every address; "
                  "add groups only if MVN sends to a multicast group.");
    case Kind::TcpListener:
        return tr("MVN connects to this computer, as it does when its protocol is TCP. Leave the "
                  "host empty to listen on every address.");
    case Kind::TcpConnection:
        break;
    }
    return tr("This computer connects to a sender that listens, and keeps trying until it "
              "answers. MVN itself does not listen.");
}

} // namespace

tl::expected<InputAddress, QString> readInput(const InputAddress& typed) {
    InputAddress input{withoutBrackets(typed.address.trimmed()), typed.port, typed.kind};
    if (typed.kind == Kind::TcpConnection) {
        if (input.address.isEmpty()) {
            return tl::unexpected(tr("Type the host to connect to."));
        }
        return input;
    }
    if (!input.address.isEmpty() && QHostAddress(input.address).isNull()) {
        return tl::unexpected(tr("'%1' is not an address. Type one of this computer's, or leave the host "
                                 "empty for all of them.")
                                  .arg(input.address));
    }
    static const QRegularExpression separators(QStringLiteral("[,;\\s]+"));
    const QString groups = typed.kind == Kind::Udp ? typed.groups.join(QLatin1Char(' ')) : QString();
    for (const QString& group : groups.split(separators, Qt::SkipEmptyParts)) {
        if (!QHostAddress(group).isMulticast()) {
            return tl::unexpected(tr("'%1' is not a multicast group: those are 224.0.0.0 to "
                                     "239.255.255.255, and ff00:: and above.")
                                      .arg(group));
        }
        input.groups += group;
    }
    if (!input.groups.isEmpty() && !input.address.isEmpty()) {
        return tl::unexpected(tr("With multicast groups, leave the host empty."));
    }
    return input;
}

InputForm::InputForm(QWidget* parent) : QWidget(parent) {
    m_protocol->addItem(tr("UDP"), static_cast<int>(Kind::Udp));
    m_protocol->addItem(tr("TCP, listening"), static_cast<int>(Kind::TcpListener));
    m_protocol->addItem(tr("TCP, connecting"), static_cast<int>(Kind::TcpConnection));
    m_port->setRange(1, kMostPort);
    m_port->setValue(kDefaultPort);
    m_port->setButtonSymbols(QAbstractSpinBox::NoButtons);
    const auto field = [this, grid = new QGridLayout(this)](const QString& text, QWidget* edit, int stretch) {
        const int column = grid->columnCount();
        QLabel* label = dimLabel(text, this);
        label->setBuddy(edit);
        grid->addWidget(label, 0, column);
        grid->addWidget(edit, 1, column);
        grid->setColumnStretch(column, stretch);
        return grid;
    };
    field(tr("Pro&tocol"), m_protocol, 0);
    field(tr("&Host"), m_host, 3);
    field(tr("&Port"), m_port, 0);
    QGridLayout* grid = field(tr("Multicast &groups"), m_groups, 2);
    grid->addWidget(m_note, 2, 1, 1, grid->columnCount() - 1);
    grid->setContentsMargins(0, 0, 0, 0);
    m_port->setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("65535")) +
                            3 * fontMetrics().height());
    connect(m_protocol, &QComboBox::currentIndexChanged, this, &InputForm::changeKind);
    for (QLineEdit* edit : {m_host, m_groups}) {
        connect(edit, &QLineEdit::textChanged, this, [this] { setProblem({}); });
    }
    connect(m_port, &QSpinBox::valueChanged, this, [this] { setProblem({}); });
    changeKind();
}

InputAddress InputForm::typed() const {
    return {m_host->text(),
            static_cast<std::uint16_t>(m_port->value()),
            static_cast<Kind>(m_protocol->currentData().toInt()),
            {m_groups->text()}};
}

void InputForm::setInput(const InputAddress& input) {
    m_protocol->setCurrentIndex(m_protocol->findData(static_cast<int>(input.kind)));
    m_host->setText(input.address);
    m_port->setValue(input.port);
    m_groups->setText(input.groups.join(QStringLiteral(", ")));
    setProblem({});
}

void InputForm::focusHost() {
    m_host->setFocus();
    m_host->selectAll();
}

void InputForm::changeKind() {
    const Kind kind = typed().kind;
    m_groups->setEnabled(kind == Kind::Udp);
    m_host->setPlaceholderText(kind == Kind::TcpConnection ? tr("name or address") : tr("every address"));
    setProblem({});
}

void InputForm::setProblem(const QString& problem) {
    m_problem = problem;
    if (m_problem.isEmpty()) {
        m_note->explain(explanation(typed().kind, !m_host->text().trimmed().isEmpty()));
    } else {
        m_note->warn(m_problem);
    }
}

void InputForm::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
        emit submitted();
        return;
    }
    QWidget::keyPressEvent(event);
}

} // namespace posewire::gui
