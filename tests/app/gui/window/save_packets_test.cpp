// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/save_packets.h"
#include "tests/app/gui/models/stage.h"

#include "core/log/recording_file.h"

#include <QTemporaryDir>
#include <QTest>

#include <gmock/gmock.h>

namespace posewire::gui {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class SavePacketsTest : public testing::Test {
protected:
    struct Saved {
        std::uint64_t packets = 0;
        std::vector<std::string> comments;
    };

    SavePacketsTest() {
        performer::Performer performer(sending(2, {2}, 60.0)); // 2 packets a frame
        m_stage.perform(performer, 0, 60);
        m_stage.follow();
    }

    Saved save(const std::function<void(SavePacketsDialog&)>& choose = {}) {
        SavePacketsDialog dialog(m_stage.session, {}, nullptr);
        if (choose) {
            choose(dialog);
        }
        const QString path = m_folder.filePath("packets.pcapng");
        QFile::remove(path);
        dialog.save(path);
        EXPECT_TRUE(QTest::qWaitFor([&] { return QFile::exists(path); }));
        Saved saved;
        const auto file = log::openFile(path.toStdString());
        EXPECT_TRUE(log::readFile(**file, [&](const log::FileRecord& record) {
            ++saved.packets;
            saved.comments.insert(saved.comments.end(), record.comments.begin(), record.comments.end());
        }));
        return saved;
    }

    Stage m_stage;
    QTemporaryDir m_folder;
};

TEST_F(SavePacketsTest, WritesAllWithWhatWasSaidOfThem) {
    m_stage.commands.setMarked(10, true);
    m_stage.commands.setMarked(11, true);
    m_stage.commands.setComment(11, "left hand jumps");
    m_stage.commands.setComment(12, "late");
    const Saved saved = save();
    EXPECT_EQ(saved.packets, 120U);
    EXPECT_THAT(saved.comments, ElementsAre("Mark", "Mark: left hand jumps", "late"));
}

TEST_F(SavePacketsTest, BeginsWithTheRangeAndTheFilterThatAreChosen) {
    m_stage.commands.setDisplayFilter("character == 1 && sample < 10");
    const std::uint64_t listed = save().packets;
    EXPECT_GT(listed, 5U);
    EXPECT_LT(listed, 12U);
    m_stage.commands.selectRange({.fixed = model::TimeRange{Stage::kStart + 500ms, m_stage.now}});
    EXPECT_EQ(save().packets, 58U) << "29 frames of both";
    EXPECT_EQ(
        save([](SavePacketsDialog& dialog) { dialog.findChild<QCheckBox*>()->setChecked(true); }).packets,
        29U);
    EXPECT_THAT(save().comments, IsEmpty());
}

} // namespace
} // namespace posewire::gui
