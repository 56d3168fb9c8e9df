// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/models/clock_history.h"
#include "app/gui/models/column.h"
#include "core/model/session/losses.h"
#include "core/model/session/verdict.h"

#include <map>
#include <optional>
#include <vector>

namespace posewire::gui {

/// What the board and its details say of a character or a stream, now on the wire, whatever the cursor.
/// Losses are of boardSpan(); rates in Hz.
struct BoardFigures {
    std::optional<double> nominalHz{};  ///< by the sender's own clock, once it is known
    std::optional<double> measuredHz{}; ///< by arrival here; nothing where nothing counts samples
    model::LossesByCause lost{};        ///< without what may still come
    double ageS = 0;
};

/// A character, through all restarts of its sender.
struct BoardRow : BoardFigures {
    model::CharacterKey key; ///< of the sender that it comes from now
    model::TakeVerdict verdict{};
    std::uint64_t restarts = 0;
    std::optional<std::uint8_t> poseType{}; ///< that its figure is drawn from; nothing without a pose
};

/// One stream of a character.
struct DetailRow : BoardFigures {
    log::StreamKey key;
};

/// The time that losses are counted in: the newest seconds, but nothing before the reset. Nothing for all of
/// a recording.
[[nodiscard]] std::optional<model::TimeRange> boardSpan(const model::SessionView& view);
/// "now, last 10 s", "now, since the reset", "whole recording".
[[nodiscard]] QString boardSpanText(const model::SessionView& view);

enum class BoardOrder : std::uint8_t { Appearance, TroubleFirst };
/// All characters of now. Trouble first: the worst verdict, else as they appeared.
[[nodiscard]] std::vector<model::CharacterKey> boardOf(const model::SessionView& view, BoardOrder order);

/// What every character's rate should be, learnt from its sender's clock; anew after each restart.
class NominalRates {
public:
    void follow(const model::SessionView& view, const std::vector<model::CharacterKey>& characters);
    /// Nothing before it is known, and where the stream counts no samples.
    [[nodiscard]] std::optional<double> of(const model::Stream& stream) const;

private:
    struct Learnt {
        std::uint8_t type = 0; ///< that it was learnt from
        std::uint64_t restarts = 0;
        std::uint64_t end = 0; ///< of a recording when it was looked at
        model::NominalRate rate;
    };
    std::map<model::CharacterKey, Learnt> m_rates;
};

/// The characters as a board: one line each.
class CharacterModel : public TableModel<BoardRow> {
public:
    enum Column : int {
        kName,
        kVerdict,
        kNominal,
        kMeasured,
        kLostHere,
        kLostOnNetwork,
        kLostAtSender,
        kLostUnknown,
        kAge,
        kPose
    };

    CharacterModel(model::SessionView& view, Commands& commands);

    void refresh();
    void setOrder(BoardOrder order) { m_order = order; }
    [[nodiscard]] BoardOrder order() const { return m_order; }

    /// Nothing for an invalid index.
    [[nodiscard]] std::optional<model::CharacterKey> character(const QModelIndex& index) const;
    /// The row of a character, before or after a restart; invalid where there is none.
    [[nodiscard]] QModelIndex indexOf(const model::CharacterKey& key) const;
    [[nodiscard]] const NominalRates& nominalRates() const { return m_rates; }

    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;

private:
    [[nodiscard]] static std::vector<TableColumn<BoardRow>> columns(model::SessionView& view);

    model::SessionView& m_view;
    Commands& m_commands;
    NominalRates m_rates;
    BoardOrder m_order = BoardOrder::Appearance;
};

/// The streams of one character, by type.
class CharacterDetailModel : public TableModel<DetailRow> {
public:
    explicit CharacterDetailModel(model::SessionView& view);

    void refresh(const std::optional<model::CharacterKey>& key, const NominalRates& rates);

private:
    model::SessionView& m_view;
};

/// A sender that others have taken over from.
struct EndedSender {
    log::SenderId sender{};
    QString address;
    QString characters; ///< their names
    QString ended;      ///< time of day
};

/// Senders that have ended, in order of appearance.
class EndedSenderModel : public TableModel<EndedSender> {
public:
    explicit EndedSenderModel(model::SessionView& view);

    void refresh();

private:
    model::SessionView& m_view;
};

/// "10.0.0.5:40001 until 03:28:07, now 10.0.0.5:40002": where a character came from.
[[nodiscard]] QString portHistory(const model::SessionView& view, const model::CharacterKey& key);
/// "restarted 2 ×"; empty where it was not.
[[nodiscard]] QString restartWords(std::uint64_t restarts);

} // namespace posewire::gui
