// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/settings.h"
#include "core/log/recording.h"
#include "core/model/session/origin.h"

#include <QObject>
#include <QString>

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace posewire::gui {

struct TakeState {
    QString path;
    double seconds = 0;
    log::RecordingFigures figures;
};

/// Records what is received, whatever is shown, one take after the other: each written from the log by a
/// thread of its own, so that neither receiving nor the window waits for the disk.
class Takes final : public QObject {
    Q_OBJECT

public:
    /// Both must outlive it.
    explicit Takes(model::Origin& origin) : m_log(origin.log()), m_live(origin.session()) {}
    /// Waits until everything is in its file.
    ~Takes() override;

    /// Begins a take with what the pre-roll wants of the past, or ends it. Returns why it cannot begin; empty
    /// if it does.
    QString toggle(const RecordingChoice& choice);
    [[nodiscard]] bool isRecording() const { return m_recording != nullptr; }
    [[nodiscard]] std::optional<TakeState> state() const;

    /// Has the marks and comments of the take as they are now noted in its file. A take that ended by itself
    /// is an incident of this computer.
    void follow(log::Stamp now);

signals:
    /// A take began or ended; `problem` is why it ended by itself, else empty.
    void changed(const QString& problem);

private:
    QString start(const RecordingChoice& choice);
    /// Ends it, with notes of how it was received and of the incidents of its time.
    void stop();
    void keepMarks();
    /// Why a take has ended by itself, or could not be ended well, since this was asked last; else empty.
    [[nodiscard]] std::string takeProblem();
    [[nodiscard]] std::vector<std::string> notesAtEnd() const;
    [[nodiscard]] log::Reception reception() const;

    const log::PacketLog& m_log;
    model::Session& m_live;
    std::unique_ptr<log::Recording> m_recording; ///< null while none runs
    QString m_path;
    std::uint64_t m_from = 0;         ///< the first packet
    model::Annotations m_annotations; ///< as they are noted
    log::Stamp m_fromStamp{};
    std::vector<std::future<std::string>> m_ending; ///< with what went wrong
};

} // namespace posewire::gui
