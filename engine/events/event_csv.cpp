#include "events/event_csv.h"

#include "core/time/time_text.h"
#include "events/stored_events.h"
#include "io/atomic_file.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"

namespace eyrie {

namespace {

std::string verdictFields(const Verdict* verdict) {
    if (verdict == nullptr) return ",,,,,,";
    return std::string(",") + nameOf(verdict->judgement) + ',' + csvField(verdict->note) + ',' +
           csvField(tagText(verdict->tags)) + (verdict->starred ? ",1," : ",0,") + csvField(verdict->person) + ',' +
           csvField(verdict->when_utc);
}

}  // namespace

void writeEventCsv(const std::filesystem::path& path, const std::vector<Event>& events, const FrameClock& clock,
                   const std::vector<const Verdict*>& verdicts, const std::vector<int>& numbers,
                   const std::vector<std::string>& makers, const FrameMoment& moment) {
    std::string text =
        "kind,first_frame,last_frame,start_s,end_s,clock,tracks,figure,unit,zone,sense,frame,x,y,ground_frame,"
        "ground_x,ground_y,verdict,note,tags,starred,person,when_utc,by,number,utc\n";
    for (std::size_t i = 0; i < events.size(); ++i) {
        const Event& event = events[i];
        std::string tracks;
        for (const TrackId id : event.tracks) tracks += (tracks.empty() ? "" : " ") + std::to_string(id);
        const bool counts = event.unit != FigureUnit::none;
        text += std::string(nameOf(event.kind)) + ',' + std::to_string(event.first_frame) + ',' +
                std::to_string(event.last_frame) + ',' + fixedText(clock(event.first_frame), 3) + ',' +
                fixedText(clock(event.last_frame), 3) + ',' + videoClockText(clock(event.first_frame)) + ',' + tracks +
                ',' + (counts ? fixedText(event.figure, 3) : "") + ',' + nameOf(event.unit) + ',' +
                csvField(event.zone) + ',' + nameOf(event.sense) + ',' + std::to_string(event.frame) + ',' +
                fixedText(event.place.x, 2) + ',' + fixedText(event.place.y, 2) + ',' +
                std::to_string(event.ground_frame) + ',' + fixedText(event.ground.x, 2) + ',' +
                fixedText(event.ground.y, 2) + verdictFields(verdicts.empty() ? nullptr : verdicts.at(i)) + ',' +
                (makers.empty() ? makerText(std::nullopt) : makers.at(i)) + ',' +
                std::to_string(numbers.empty() ? static_cast<int>(i) + 1 : numbers.at(i)) + ',' +
                (moment ? moment(event.first_frame) : "") + '\n';
    }
    writeFileAtomically(path, text);
}

}  // namespace eyrie
