// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/recording_dialogs.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/base/saving.h"
#include "app/gui/driver/history.h"
#include "app/gui/inputs/ways_out_page.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/words.h"
#include "app/net/relay.h"

#include <QDateTime>
#include <QDialogButtonBox>
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

namespace {

/// A field that writes a complete number into `value`.
QSpinBox* addNumber(QFormLayout& rows, const QString& label, const QString& unit, int& value, int least,
                    int most, const QString& none = {}) {
    auto* box = new QSpinBox(rows.parentWidget());
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setKeyboardTracking(false);
    box->setRange(least, most);
    box->setSuffix(unit);
    box->setSpecialValueText(none);
    box->setValue(value);
    rows.addRow(label, box);
    QObject::connect(box, &QSpinBox::valueChanged, box, [&value](int number) { value = number; });
    return box;
}

void addFolder(QFormLayout& rows, RecordingChoice& choice) {
    auto* field = new QWidget(rows.parentWidget());
    auto* line = new QLineEdit(recordingFolder(choice), field);
    auto* choose = new QPushButton(tr("Choose…"), field);
    auto* row = spacedRow({}, -1, field);
    row->addWidget(line, 1);
    row->addWidget(choose);
    field->setFocusProxy(line);
    line->setAccessibleName(tr("Folder"));
    rows.addRow(tr("&Folder"), field);
    QObject::connect(line, &QLineEdit::editingFinished, field, [line, &choice] {
        const QString folder = line->text().trimmed();
        choice.folder = folder == recordingFolder({}) ? QString() : folder;
    });
    QObject::connect(choose, &QPushButton::clicked, line, [line] {
        auto* dialog = new QFileDialog(line, tr("Folder of recordings"), line->text());
        dialog->setFileMode(QFileDialog::Directory);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        QObject::connect(dialog, &QFileDialog::fileSelected, line, [line](const QString& folder) {
            line->setText(folder);
            emit line->editingFinished();
        });
        dialog->open();
    });
}

/// A pattern that cannot be used is marked, and the one before stays.
void addPattern(QFormLayout& rows, RecordingChoice& choice) {
    auto* line = new QLineEdit(choice.pattern, rows.parentWidget());
    auto* note = new Note(rows.parentWidget());
    line->setPlaceholderText(QLatin1String(RecordingChoice::kDefaultPattern));
    note->setAccessibleDescription(tr("Name"));
    rows.addRow(tr("&Name"), line);
    rows.addRow({}, note);
    const auto check = [line, note, &choice] {
        RecordingChoice typed = choice;
        typed.pattern = line->text().trimmed();
        const QFileInfo next(nextTakePath(typed, QDateTime::currentDateTime()));
        const QString problem = patternProblem(typed.pattern);
        problem.isEmpty() ? note->explain(tr("Next: %1").arg(next.fileName())) : note->warn(problem);
    };
    QObject::connect(line, &QLineEdit::textChanged, note, check);
    QObject::connect(line, &QLineEdit::editingFinished, note, [line, &choice] {
        const QString pattern = line->text().trimmed();
        choice.pattern = patternProblem(pattern).isEmpty() ? pattern : choice.pattern;
    });
    check();
}

/// "In memory: 512 MB of at most 1 024 MB. On disk: …": how far one can look back now.
QString historyStateText(const model::SessionView& live, const History& history) {
    const auto first = live.packet(live.begin());
    const QString inMemory =
        tr("In memory: %1 of at most %2.")
            .arg(megabytes(live.log().figures().memoryInUse), megabytes(live.log().figures().memoryCap));
    const log::DiskHistory* disk = history.onDisk();
    const auto failure = disk != nullptr ? disk->failure() : std::nullopt;
    QString onDisk = failure           ? QString::fromStdString(failure->text)
                     : disk != nullptr ? tr("On disk: %1.").arg(megabytes(disk->figures().bytes))
                                       : tr("On disk: nothing.");
    if (live.log().past().isDamaged()) {
        onDisk += u' ' + tr("Another program has changed its files: some of it is lost.");
    }
    const QString since = first
                              ? tr("The oldest packet is from %1.").arg(timeOfDay(live.wallOf(first->stamp)))
                              : tr("Nothing was received yet.");
    return inMemory + u' ' + onDisk + u' ' + since;
}

} // namespace

void addRecordingRows(QFormLayout& rows, RecordingChoice& choice) {
    rows.addRow(dimText(tr("A take has everything that is received while it runs, as pcapng: Posewire "
                           "and Wireshark open it. In its name {take} is a number, {date} and {time} "
                           "are when it begins. What is chosen here counts from the next take on."),
                        rows.parentWidget()));
    addFolder(rows, choice);
    addPattern(rows, choice);
    addNumber(rows, tr("&Keep before"), tr(" s"), choice.preRollSeconds, 0, RecordingChoice::kMostPreRoll,
              tr("nothing"));
    addNumber(rows, tr("New file ever&y"), tr(" MB"), choice.fileMegabytes, 0,
              RecordingChoice::kMostMegabytes, tr("one file, however large"));
    addNumber(rows, tr("New file af&ter"), tr(" min"), choice.fileMinutes, 0, RecordingChoice::kMostMinutes,
              tr("one file, however long"));
    addNumber(rows, tr("Lea&ve free"), tr(" MB"), choice.freeMegabytes, 0, RecordingChoice::kMostMegabytes,
              tr("nothing: until the disk is full"));
}

void addHistoryRows(QFormLayout& rows, HistoryChoice& choice, const History& history,
                    const model::SessionView& live) {
    QWidget* form = rows.parentWidget();
    rows.addRow(dimText(tr("What was received can be looked back at as long as it is in memory or on disk; "
                           "the oldest goes first. On disk it takes at most a tenth of what is free, in "
                           "%1, and goes when Posewire ends. To keep a take, record it. A change applies "
                           "when this window is closed.")
                            .arg(history.folder()),
                        form));
    auto* isOnDisk = new QCheckBox(tr("Keep on &disk what memory has no room for"), form);
    isOnDisk->setChecked(choice.isOnDisk);
    rows.addRow({}, isOnDisk);
    QSpinBox* most =
        addNumber(rows, tr("At &most"), tr(" GB"), choice.gigabytes, 1, HistoryChoice::kMostGigabytes);
    most->setEnabled(choice.isOnDisk);
    most->setAccessibleName(tr("Size of the history on disk, at most"));
    rows.addRow({}, dimText(historyStateText(live, history), form));
    QObject::connect(isOnDisk, &QCheckBox::toggled, form, [&choice, most](bool isOn) {
        choice.isOnDisk = isOn;
        most->setEnabled(isOn);
    });
}

namespace {

constexpr std::chrono::milliseconds kLook{100};
constexpr int kPath = Qt::UserRole;
constexpr int kSize = 3; // column

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
        const QString day = QLocale().toString(dateTimeOf(begin).date(), QLocale::ShortFormat);
        auto* item =
            new QTreeWidgetItem(m_list, {day, timeOfDay(begin), timeOfDay(one.end), megabytes(one.bytes)});
        item->setTextAlignment(kSize, Qt::AlignRight | Qt::AlignVCenter);
        item->setData(0, kPath, QString::fromStdString(one.path));
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
    const auto place = readTarget(m_target->text());
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
    std::ranges::transform(m_receiving.state().ports, std::back_inserter(inputs), &PortState::status);
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
    question.setDefaultButton(QMessageBox::Cancel);
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
