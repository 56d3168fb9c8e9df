// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the texts of the core's tables as lupdate reads them: the window translates them by their source.
#include "core/export/formats.h"
#include "core/export/motion/motion_export.h"
#include "core/log/packet_log.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/body/null_pose_measures.h"
#include "core/model/incidents/incident.h"
#include "core/model/incidents/thresholds.h"
#include "core/model/session/memory_figures.h"
#include "core/model/session/session.h"
#include "core/wire/faults.h"
#include "core/wire/type_table.h"
#include "core/words/say.h"

#include <cstdio>
#include <set>
#include <string>

namespace {

using namespace posewire;

std::set<std::string> texts;

void add(std::string_view text) {
    texts.emplace(text);
}

void add(const char* text) {
    texts.emplace(text == nullptr ? "" : text);
}

void addFields(std::span<const wire::FieldRow> rows) {
    for (const wire::FieldRow& row : rows) {
        add(row.about.text);
        for (const wire::FieldPart& part : row.about.parts) {
            add(part.text);
        }
        addFields(row.items);
    }
}

template <class Formats>
void addKinds(const Formats& formats) {
    for (const auto& format : formats) {
        add(format.kind);
    }
}

std::string literal(const std::string& text) {
    std::string quoted = "\"";
    for (const char letter : text) {
        quoted += letter == '\n' ? "\\n" : std::string(letter == '"' || letter == '\\', '\\') + letter;
    }
    return quoted + '"';
}

/// The faults hand their texts to the language.
std::string addFault(const char* text, const char* one, std::uint32_t /*number*/) {
    if (one == nullptr) {
        add(text);
    } else {
        std::printf("QT_TRANSLATE_N_NOOP(\"posewire::core\", %s)\n", literal(text).c_str());
    }
    return {};
}

void addTables() {
    for (std::size_t code = 0; code < wire::kErrorCodeCount; ++code) {
        wire::errorText({static_cast<wire::ErrorCode>(code), 0, 0, 1}, addFault);
    }
    wire::errorText({wire::ErrorCode::TooLong}, addFault);
    for (std::size_t code = 0; code < wire::kNoticeCodeCount; ++code) {
        wire::noticeText({static_cast<wire::NoticeCode>(code)}, addFault);
    }
    addFields(wire::headerRows());
    for (const wire::TypeInfo& type : wire::typeTable()) {
        add(type.name);
        add(type.remark);
        add(wire::frameName(type.frame));
        for (const wire::FormRow& form : type.forms) {
            addFields(form.fields);
        }
    }
    for (const model::FigureRow& row : model::figureTable()) {
        add(row.shortTitle());
        add(row.title);
        add(row.help);
        add(row.packets);
    }
    for (const model::ThresholdRow& row : model::thresholdTable()) {
        add(row.label);
        add(row.unit);
        add(row.help);
    }
    for (const exporting::MotionFormat& format : exporting::motionFormats()) {
        add(format.kind);
        add(format.holds);
    }
    addKinds(exporting::formats<exporting::EventSheet>());
    addKinds(exporting::formats<exporting::NullPoseSheet>());
    addKinds(exporting::formats<exporting::ReportSheet>());
    for (const model::IncidentKindFacts& kind : model::kIncidentKindTable) {
        add(kind.name);
    }
    for (const char* text : {"Check", "Debug", "Inspect", "bodies drawn"}) {
        add(text);
    }
    const log::PacketLog log;
    for (const model::MemoryFigures::Part& part : model::Session(log).memory().parts) {
        add(part.name);
    }
    for (const model::SegmentLength& length : model::measure({}).lengths) {
        add(length.name);
    }
    for (std::size_t cause = 0; cause < model::kLossCauses; ++cause) {
        add(model::nameOf(static_cast<model::LossCause>(cause)));
    }
}

} // namespace

int main() {
    addTables();
    texts.erase("");
    for (const std::string& text : texts) {
        std::printf("QT_TRANSLATE_NOOP(\"posewire::core\", %s)\n", literal(text).c_str());
    }
    for (const words::Wording& row : words::wordings()) {
        for (const words::Text& text :
             {row.headline, row.sentence, row.line, row.brief, row.cell, row.narrow, row.advice}) {
            if (text.text != nullptr && *text.text != '\0') {
                std::printf("%s(\"posewire::words\", %s)\n",
                            text.one != nullptr ? "QT_TRANSLATE_N_NOOP" : "QT_TRANSLATE_NOOP",
                            literal(text.text).c_str());
            }
        }
    }
}
