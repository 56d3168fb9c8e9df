// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/recording_dialogs.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/base/saving.h"
#include "app/gui/driver/history.h"
#include "app/gui/inputs/relay_page.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/net/relay.h"

#include <QDateTime>
#include <QDialogButtonBox>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHeaderView>
#include <QHostAddress>
#include <QLocale>
#include <QSpinBox>

#include <chrono>
#include <cmath>

namespace posewire::gui {

RecordingDialog::RecordingDialog(const RecordingChoice& choice, QWidget* parent)
    : QDialog(parent),
      m_folder(new QLineEdit(recordingFolder(choice), this)),
      m_pattern(new QLineEdit(choice.pattern, this)) {
    setWindowTitle(tr("Recording options"));
    auto* form = new QFormLayout;
    auto* folder = new QWidget(this);
    auto* row = spacedRow({}, -1, folder);
    folder->setFocusProxy(m_folder);
    auto* choose = new QPushButton(tr("Choose…"), this);
    row->addWidget(m_folder, 1);
    row->addWidget(choose);
    form->addRow(tr("&Folder"), folder);
    form->addRow(tr("&Name"), m_pattern);
    form->addRow({}, m_next);
    m_pattern->setPlaceholderText(QLatin1String(RecordingChoice::kDefaultPattern));
    m_preRoll = addNumber(*form, tr("&Keep before"), tr(" s"), tr("nothing"), choice.preRollSeconds,
                          RecordingChoice::kMostPreRoll);
    m_megabytes = addNumber(*form, tr("New file &every"), tr(" MB"), tr("one file, however large"),
                            choice.fileMegabytes, RecordingChoice::kMostMegabytes);
    m_minutes = addNumber(*form, tr("New file &after"), tr(" min"), tr("one file, however long"),
                          choice.fileMinutes, RecordingChoice::kMostMinutes);
    m_free = addNumber(*form, tr("&Leave free"), tr(" MB"), tr("nothing: until the disk is full"),
                       choice.freeMegabytes, RecordingChoice::kMostMegabytes);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    m_ok = buttons->button(QDialogButtonBox::Ok);
    connect(choose, &QPushButton::clicked, this, &RecordingDialog::chooseFolder);
    connect(m_pattern, &QLineEdit::textChanged, this, &RecordingDialog::check);
    connect(m_folder, &QLineEdit::textChanged, this, &RecordingDialog::check);
    layOut(*this,
           {dimText(tr("A take has everything that is received while it runs, as pcapng: Posewire "
                       "and Wireshark open it. In its name {take} is a number, {date} and {time} "
                       "are when it begins. What is chosen here counts from the next take on."),
                    this),
            form},
           *buttons, placeOf(HelpTopic::RecordingOptions), 66);
    check();
}

QSpinBox* RecordingDialog::addNumber(QFormLayout& form, const QString& label, const QString& unit,
                                     const QString& none, int value, int most) {
    auto* box = new QSpinBox(this);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setRange(0, most);
    box->setSuffix(unit);
    box->setSpecialValueText(none);
    box->setValue(value);
    form.addRow(label, box);
    return box;
}

void RecordingDialog::chooseFolder() {
    const QString folder =
        QFileDialog::getExistingDirectory(this, tr("Folder of recordings"), m_folder->text());
    if (!folder.isEmpty()) {
        m_folder->setText(folder);
    }
}

void RecordingDialog::check() {
    const QString problem = patternProblem(m_pattern->text());
    m_ok->setEnabled(problem.isEmpty());
    const QString next = QFileInfo(nextTakePath(choice(), QDateTime::currentDateTime())).fileName();
    m_next->setText(problem.isEmpty() ? tr("Next: %1").arg(next) : problem);
}

RecordingChoice RecordingDialog::choice() const {
    RecordingChoice choice;
    const QString folder = m_folder->text().trimmed();
    choice.folder = folder == recordingFolder({}) ? QString() : folder;
    choice.pattern = m_pattern->text().trimmed();
    choice.preRollSeconds = m_preRoll->value();
    choice.fileMegabytes = m_megabytes->value();
    choice.fileMinutes = m_minutes->value();
    choice.freeMegabytes = m_free->value();
    return choice;
}

namespace {

constexpr std::chrono::milliseconds kLook{100};
constexpr int kPath = Qt::UserRole;
constexpr int kSize = 3; // column

QString day(log::WallTime time) {
    return QLocale().toString(dateTimeOf(time).date(), QLocale::ShortFormat);
}

constexpr std::chrono::milliseconds kReplayLook{200};
constexpr int kOverTcp = 1; // of the transports

bool isRunning(const Replaying& replaying) {
    return replaying.current() != nullptr && !replaying.current()->figures().isOver;
}

} // namespace

RecoveryDialog::RecoveryDialog(History& history, QWidget* parent) : QDialog(parent), m_history(history) {
    setWindowTitle(tr("Recovered packets"));
    m_list->setRootIsDecorated(false);
    m_list->setUniformRowHeights(true);
    m_list->setAccessibleName(tr("Recovered packets"));
    m_list->setHeaderLabels({tr("Day"), tr("Received from"), tr("Until"), tr("Size")});
    m_list->headerItem()->setTextAlignment(kSize, Qt::AlignRight | Qt::AlignVCenter);
    for (int column = 0; column < m_list->columnCount(); ++column) {
        m_list->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    }
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    m_open = buttons->addButton(tr("&Open"), QDialogButtonBox::ActionRole);
    m_save = buttons->addButton(tr("&Save as…"), QDialogButtonBox::ActionRole);
    m_discard = buttons->addButton(tr("&Discard all"), QDialogButtonBox::ActionRole);
    layOut(*this,
           {dimText(tr("Posewire did not end as it should, and these packets were not saved. Each "
                       "line is a file; the newest is selected. They are kept until the history "
                       "needs their room on the disk."),
                    this),
            m_list, m_message},
           *buttons, placeOf(HelpTopic::Recovered), 68);
    connect(m_open, &QPushButton::clicked, this, &RecoveryDialog::open);
    connect(m_save, &QPushButton::clicked, this, &RecoveryDialog::askWhereToSave);
    connect(m_discard, &QPushButton::clicked, this, &RecoveryDialog::discard);
    connect(m_list, &QTreeWidget::itemActivated, this, &RecoveryDialog::open);
    m_watch->setInterval(kLook);
    connect(m_watch, &QTimer::timeout, this, &RecoveryDialog::watchSaving);
    m_open->setDefault(true);
    m_list->setFocus();
    fill();
    showState({});
}

void RecoveryDialog::fill() {
    m_list->clear();
    for (const log::LostHistory& one : m_history.lost()) {
        const log::WallTime begin = log::beginOf(one.path).value_or(one.end);
        auto* item = new QTreeWidgetItem(
            m_list, {day(begin), timeOfDay(begin), timeOfDay(one.end), megabytes(one.bytes)});
        item->setTextAlignment(kSize, Qt::AlignRight | Qt::AlignVCenter);
        item->setData(0, kPath, QFile::decodeName(one.path.c_str()));
        m_list->setCurrentItem(item);
    }
}

QString RecoveryDialog::selected() const {
    const QTreeWidgetItem* item = m_list->currentItem();
    return item == nullptr ? QString() : item->data(0, kPath).toString();
}

void RecoveryDialog::open() {
    if (const QString path = selected(); !path.isEmpty()) {
        emit openRequested(path);
    }
}

void RecoveryDialog::askWhereToSave() {
    const QString path = gui::askWhereToSave(this, tr("Save recovered packets"),
                                             QStringLiteral("recovered.pcapng"), tr("Recording (*.pcapng)"));
    if (!path.isEmpty()) {
        save(path);
    }
}

void RecoveryDialog::save(const QString& path) {
    m_target = path;
    m_saving = saveCopy(selected(), path);
    m_watch->start();
    showState(tr("Saving %1 …").arg(path));
}

void RecoveryDialog::watchSaving() {
    if (m_saving.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        m_watch->stop();
        const QString problem = m_saving.get();
        const QString text = problem.isEmpty() ? tr("Saved %1").arg(m_target) : problem;
        showState(text);
        if (isHidden()) {
            emit over(text);
        }
    }
}

void RecoveryDialog::done(int result) {
    QDialog::done(result);
    if (!m_watch->isActive()) {
        emit over({});
    }
}

void RecoveryDialog::discard() {
    MessageBox question(tr("Discard"), tr("Discard all recovered packets? They cannot be brought back."),
                        QMessageBox::Discard | QMessageBox::Cancel, this);
    if (question.exec() == QMessageBox::Discard) {
        m_history.discardLost();
        fill();
        showState({});
    }
}

void RecoveryDialog::showState(const QString& message) {
    const bool isSaving = m_watch->isActive();
    m_message->setText(message.isEmpty() && isEmpty() ? tr("There is nothing to recover.") : message);
    m_message->setVisible(!m_message->text().isEmpty());
    for (QPushButton* button : {m_open, m_save, m_discard}) {
        button->setEnabled(!isEmpty() && !isSaving);
    }
}

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

ReplayDialog::ReplayDialog(Replaying& replaying, const Receiving& receiving, const Commands& commands,
                           QString& target, QWidget* parent)
    : QDialog(parent), m_replaying(replaying), m_receiving(receiving), m_commands(commands), m_kept(target) {
    setWindowTitle(tr("Replay to the network"));
    m_target->setPlaceholderText(QStringLiteral("192.168.1.20:9763"));
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
    form->addRow(tr("S&peed"), m_speed);
    form->addRow({}, m_loop);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(m_button, QDialogButtonBox::ActionRole);
    m_button->setDefault(true);
    layOut(*this,
           {dimText(tr("Sends the datagrams that are shown, live or of the recording, unchanged and "
                       "as far apart as they came. It goes on when this window is closed."),
                    this),
            form, m_state},
           *buttons, placeOf(HelpTopic::Replay), 74);
    connect(m_button, &QPushButton::clicked, this, &ReplayDialog::toggle);
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
    if (!isMeant(request.target.endpoint)) {
        return;
    }
    m_kept = m_target->text();
    request.target.transport = m_transport->currentIndex() == kOverTcp ? net::SendTarget::Transport::Tcp
                                                                       : net::SendTarget::Transport::Udp;
    request.speed = m_speed->value();
    request.isLooping = m_loop->isChecked();
    request.range = m_range->range();
    m_problem = m_replaying.start(request, m_commands.session());
}

bool ReplayDialog::isMeant(const net::Endpoint& target) {
    std::vector<net::InputStatus> inputs;
    for (const PortState& port : m_receiving.state().ports) {
        inputs.push_back(port.status);
    }
    const QHostAddress address(target.host == "localhost" ? QStringLiteral("127.0.0.1")
                                                          : QString::fromStdString(target.host));
    if (!net::loopProblem(target, address, inputs)) {
        return true;
    }
    MessageBox question(
        windowTitle(),
        tr("%1 is an input of this monitor: it would receive what it sends as if a sender had "
           "sent it again.")
            .arg(QString::fromStdString(net::textOf(target))),
        QMessageBox::Cancel, this);
    const auto* send = question.addButton(tr("&Send to this monitor"), QMessageBox::AcceptRole);
    question.exec();
    return question.clickedButton() == send;
}

void ReplayDialog::refresh() {
    const net::Replay* replay = m_replaying.current();
    m_button->setText(isRunning(m_replaying) ? tr("&Stop sending") : tr("&Send"));
    m_state->setText(!m_problem.isEmpty() ? m_problem
                     : replay != nullptr  ? replayText(*replay)
                                          : tr("Nothing is being sent."));
}

} // namespace posewire::gui
