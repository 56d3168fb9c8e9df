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
    ~Takes() override { static_cast<void>(end()); }

    /// Begins a take with what the pre-roll wants of the past, or ends it. Returns why it cannot begin; empty
    /// if it does.
    QString toggle(const RecordingChoice& choice);
    [[nodiscard]] bool isRecording() const { return m_take.recording != nullptr; }
    [[nodiscard]] std::optional<TakeState> state() const;

    /// Has the marks and comments of the take as they are now noted in its file. A take that ended by itself,
    /// or had to go on in another file, is an incident of this computer.
    void follow(log::Stamp now);

    /// Ends the take and waits until everything is in its file. False if not all takes are on the disk.
    [[nodiscard]] bool end();

signals:
    /// A take began or ended; `problem` is why it ended by itself or is in another file, else empty.
    void changed(const QString& problem);
    /// It is on the disk, under that name.
    void recorded(const QString& path, double seconds);

private:
    struct Take {
        std::shared_ptr<log::Recording> recording{}; ///< null while none runs
        std::size_t told = 0;                        ///< of its files that are gone
        double seconds = 0;
        std::future<void> ending{};
    };

    QString start(const RecordingChoice& choice);
    /// Ends it, with notes of how it was received and of the incidents of its time.
    void stop();
    void keepMarks();
    void tell(log::Stamp now, const words::Fact& what);
    void tellDisplaced(log::Stamp now, Take& take);
    void conclude(log::Stamp now, Take& take);
    [[nodiscard]] std::vector<std::string> notesAtEnd() const;
    [[nodiscard]] log::Reception reception() const;

    const log::PacketLog& m_log;
    model::Session& m_live;
    Take m_take;
    bool m_isAnyLost = false;         ///< a take is not on the disk, or not all of it
    std::uint64_t m_from = 0;         ///< the first packet
    model::Annotations m_annotations; ///< as they are noted
    log::Stamp m_fromStamp{};
    std::vector<Take> m_ending;
};

} // namespace posewire::gui
