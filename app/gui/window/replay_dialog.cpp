// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/replay_dialog.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/inputs/relay_page.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/window/range_box.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>

#include <chrono>
#include <cmath>

namespace posewire::gui {

namespace {

constexpr std::chrono::milliseconds kReplayLook{200};
constexpr int kOverTcp = 1; // of the transports

bool isRunning(const Replaying& replaying) {
    return replaying.current() != nullptr && !replaying.current()->figures().isOver;
}

} // namespace

QString replayText(const net::Replay& replay) {
    const net::ReplayFigures figures = replay.figures();
    const net::ReplayChoice& choice = replay.choice();
    const QString place = QString::fromStdString(net::textOf(choice.target.endpoint));
    if (!figures.problem.empty()) {
        return QString::fromStdString(figures.problem);
    }
    const double share =
        static_cast<double>(figures.position - choice.begin) / static_cast<double>(choice.end - choice.begin);
    QStringList parts{figures.isOver
                          ? ReplayDialog::tr("Sent to %1").arg(place)
                          : ReplayDialog::tr("Sending to %1: %2 %").arg(place).arg(std::floor(100 * share))};
    parts += ReplayDialog::tr("%1 datagrams").arg(grouped(figures.sent));
    if (choice.isLooping) {
        parts += ReplayDialog::tr("round %1").arg(grouped(figures.rounds + 1));
    }
    if (figures.refused != 0) {
        parts += ReplayDialog::tr("%1 refused by this system").arg(grouped(figures.refused));
    }
    if (figures.missing != 0) {
        parts += ReplayDialog::tr("%1 no longer in memory").arg(grouped(figures.missing));
    }
    return parts.join(QStringLiteral(" · "));
}

ReplayDialog::ReplayDialog(Replaying& replaying, const Commands& commands, QWidget* parent)
    : QDialog(parent),
      m_replaying(replaying),
      m_commands(commands),
      m_target(new QLineEdit(QStringLiteral("127.0.0.1:9763"), this)),
      m_transport(new ComboBox(this)),
      m_range(new RangeBox(this)),
      m_speed(new QDoubleSpinBox(this)),
      m_loop(new QCheckBox(tr("&Again and again"), this)),
      m_state(dimText({}, this)),
      m_button(new QPushButton(this)) {
    setWindowTitle(tr("Replay to the network"));
    m_transport->addItems({tr("UDP, a datagram each"), tr("TCP, connecting as MVN does")});
    m_speed->setButtonSymbols(QAbstractSpinBox::NoButtons);
    m_speed->setRange(net::ReplayChoice::kSlowest, net::ReplayChoice::kFastest);
    m_speed->setDecimals(2);
    m_speed->setValue(1);
    m_speed->setSuffix(tr(" ×"));
    m_loop->setObjectName(QStringLiteral("loop"));
    auto* form = new QFormLayout;
    form->addRow(tr("&To"), m_target);
    form->addRow(tr("&By"), m_transport);
    form->addRow(tr("&What"), m_range);
    form->addRow(tr("&Speed"), m_speed);
    form->addRow({}, m_loop);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(m_button, QDialogButtonBox::ActionRole);
    m_button->setDefault(true);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height());
    column->addWidget(
        dimText(tr("Sends the datagrams that are shown, live or of the recording, unchanged and "
                   "as far apart as they came. It goes on when this window is closed."),
                this));
    column->addLayout(form);
    column->addWidget(m_state);
    column->addWidget(buttons);
    setMinimumWidth(fontMetrics().averageCharWidth() * 62);
    connect(m_button, &QPushButton::clicked, this, &ReplayDialog::toggle);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    offerHelp(*this, *buttons, placeOf(HelpTopic::Replay));
    auto* look = new QTimer(this);
    connect(look, &QTimer::timeout, this, &ReplayDialog::refresh);
    look->start(kReplayLook);
    refresh();
}

void ReplayDialog::toggle() {
    if (isRunning(m_replaying)) {
        m_replaying.stop();
    } else {
        begin();
    }
    refresh();
}

void ReplayDialog::begin() {
    const auto place = readRelay(m_target->text());
    if (!place) {
        m_problem = place.error();
        return;
    }
    ReplayRequest request;
    request.target.endpoint = {place->host.toStdString(), place->port};
    request.target.transport = m_transport->currentIndex() == kOverTcp ? net::SendTarget::Transport::Tcp
                                                                       : net::SendTarget::Transport::Udp;
    request.speed = m_speed->value();
    request.isLooping = m_loop->isChecked();
    request.isRangeOnly = m_range->isRangeOnly();
    m_problem = m_replaying.start(request, m_commands.session());
}

void ReplayDialog::refresh() {
    const net::Replay* replay = m_replaying.current();
    m_button->setText(isRunning(m_replaying) ? tr("&Stop sending") : tr("&Send"));
    m_state->setText(!m_problem.isEmpty() ? m_problem
                     : replay != nullptr  ? replayText(*replay)
                                          : tr("Nothing is being sent."));
}

} // namespace posewire::gui
