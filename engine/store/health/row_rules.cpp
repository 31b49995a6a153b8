#include "store/health/row_rules.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include "core/error.h"
#include "core/review/track_correction.h"
#include "core/time/utc_time.h"
#include "store/details/squeezed_bytes.h"
#include "store/labels/packed_labels.h"
#include "store/project/sequence_rows.h"
#include "store/review/packed_review.h"
#include "store/review/review_words.h"
#include "store/runs/packed_arrays.h"
#include "store/runs/stored_words.h"

namespace eyrie {
namespace {

constexpr char kPixels[] = " BETWEEN 1 AND 65536";
constexpr char kRate[] = " BETWEEN 1e-9 AND 1e9";

template <class Enum, std::size_t count>
std::string isOneOf(const std::string& column, const std::array<stored::Word<Enum>, count>& words) {
    std::string condition;
    for (const auto& entry : words)
        condition += std::string(condition.empty() ? "'" : ", '").append(entry.word).append("'");
    return column + " IN (" + condition + ")";
}

/// Texts that are read as a whole, of columns "a, b".
std::string areShort(const std::string& columns) {
    std::string condition;
    for (std::size_t at = 0; at < columns.size();) {
        const std::size_t end = std::min(columns.find(',', at), columns.size());
        condition += (condition.empty() ? "" : " AND ") + ("octets(" + columns.substr(at, end - at) + ") <= 65536");
        at = end + 2;
    }
    return condition;
}

/// Finite numbers, of columns "a, b".
std::string areNumbers(const std::string& columns) {
    std::string condition;
    for (std::size_t at = 0; at < columns.size();) {
        const std::size_t end = std::min(columns.find(',', at), columns.size());
        condition += (condition.empty() ? "" : " AND ") + (columns.substr(at, end - at) + " BETWEEN -1e300 AND 1e300");
        at = end + 2;
    }
    return condition;
}

void answerOctets(sqlite3_context* context, int, sqlite3_value** values) {
    sqlite3_result_int(context, sqlite3_value_bytes(values[0]));
}

/// SQL function of one value: whether `unpack` reads it. NULL is no array; rows have it for none.
template <auto unpack>
void answerReadable(sqlite3_context* context, int, sqlite3_value** values) {
    const auto* data = static_cast<const std::byte*>(sqlite3_value_blob(values[0]));
    const auto size = static_cast<std::size_t>(sqlite3_value_bytes(values[0]));
    sqlite3_result_int(context, unpack(ByteView(data, size)).has_value() ? 1 : 0);
}

/// SQL function of a text: whether it is a moment.
void answerMoment(sqlite3_context* context, int, sqlite3_value** values) {
    const auto* text = reinterpret_cast<const char*>(sqlite3_value_text(values[0]));
    const auto size = static_cast<std::size_t>(sqlite3_value_bytes(values[0]));
    sqlite3_result_int(context, text != nullptr && utcOf({text, size}) ? 1 : 0);
}

/// SQL function of shape and points: whether they make a zone.
void answerZone(sqlite3_context* context, int, sqlite3_value** values) {
    const auto* shape = reinterpret_cast<const char*>(sqlite3_value_text(values[0]));
    const auto* data = static_cast<const std::byte*>(sqlite3_value_blob(values[1]));
    const auto points = unpackPolygon(ByteView(data, static_cast<std::size_t>(sqlite3_value_bytes(values[1]))));
    bool good = points && points->size() <= kMostZonePoints && shape != nullptr;
    if (good) {
        Zone zone;
        for (const auto& entry : stored::kZoneShapes)
            if (entry.word == shape) zone.shape = entry.value;
        zone.points = *points;
        good = faultOf(zone).empty();
    }
    sqlite3_result_int(context, good ? 1 : 0);
}

/// SQL function of kind, frame, track and other: whether they make a correction of tracks.
void answerCorrection(sqlite3_context* context, int, sqlite3_value** values) {
    const auto* kind = reinterpret_cast<const char*>(sqlite3_value_text(values[0]));
    const auto sightingsAt = [&](int column) {
        const auto* data = static_cast<const std::byte*>(sqlite3_value_blob(values[column]));
        return unpackSightings(ByteView(data, static_cast<std::size_t>(sqlite3_value_bytes(values[column]))));
    };
    const auto track = sightingsAt(2);
    const auto other = sightingsAt(3);
    bool good = kind != nullptr && track && other;
    if (good) {
        TrackCorrection correction;
        correction.id = 1;
        correction.frame = sqlite3_value_int(values[1]);
        correction.track = *track;
        correction.other = *other;
        for (const auto& entry : stored::kCorrectionKinds)
            if (entry.word == kind) correction.kind = entry.value;
        try {
            checkCorrection(correction);
        } catch (const Error&) {
            good = false;
        }
    }
    sqlite3_result_int(context, good ? 1 : 0);
}

}  // namespace

void addRowFunctions(SQLite::Database& database) {
    const auto add = [&](const char* name, auto function) {
        sqlite3_create_function(database.getHandle(), name, 1, SQLITE_UTF8 | SQLITE_DETERMINISTIC, nullptr, function,
                                nullptr, nullptr);
    };
    add("are_motion_vectors", answerReadable<unpackMotionVectors>);
    add("are_squeezed_vectors", answerReadable<unsqueezeMotionVectors>);
    add("are_squeezed_boxes", answerReadable<unsqueezeBoxes>);
    add("octets", answerOctets);
    add("is_moment", answerMoment);
    add("are_points", answerReadable<unpackPoints>);
    add("are_indices", answerReadable<unpackIndices>);
    add("are_keyframes", answerReadable<unpackKeyframes>);
    add("are_corners", answerReadable<unpackPolygon>);
    add("is_review_step", answerReadable<unpackReview>);
    sqlite3_create_function(database.getHandle(), "is_zone", 2, SQLITE_UTF8 | SQLITE_DETERMINISTIC, nullptr, answerZone,
                            nullptr, nullptr);
    sqlite3_create_function(database.getHandle(), "is_correction", 4, SQLITE_UTF8 | SQLITE_DETERMINISTIC, nullptr,
                            answerCorrection, nullptr, nullptr);
}

std::string fittingScaleOrigin() {
    static_assert(kMostUncertain == 1e9);
    return isOneOf("scale_origin", stored::kScaleOrigins) +
           " AND (CASE WHEN gsd_known THEN 1 ELSE 0 END) = (scale_origin IN ('given', 'metadata'))"
           " AND (scale_uncertainty IS NULL OR scale_uncertainty BETWEEN 1 AND 1e9)"
           " AND typeof(scale_vehicles) = 'integer' AND scale_vehicles BETWEEN 0 AND 2147483647";
}

std::string fittingScaleSlope() {
    static_assert(ScaleSlope::kSteepest == 1);
    return "scale_growth_right BETWEEN -1 AND 1 AND scale_growth_down BETWEEN -1 AND 1";
}

std::string fittingVideoStart() {
    return "(start_utc = '' OR is_moment(start_utc))";
}

std::string fittingRunStart() {
    return "(started_fraction_us IS NULL OR "
           "typeof(started_fraction_us) = 'integer' AND started_fraction_us BETWEEN 0 AND 999999)";
}

std::vector<RowRule> rowRules() {
    const std::string frames = " BETWEEN 0 AND " + std::to_string(kLastFrame + 1);
    const std::string frame = "frame" + frames;
    const std::string in_video = "frame BETWEEN 0 AND " + std::to_string(kLastFrame);
    const std::string range = "first_frame" + frames + " AND last_frame" + frames;
    // Labels may end where nothing ends: there the video's length was unknown.
    // Written out below: no locale may turn their points.
    static_assert(kFinestGsd == 1e-4 && kCoarsestGsd == 1e4 && kLeastZoom == 1e-2 && kMostZoom == 1e2);
    const std::string life = "first_frame >= 0 AND last_frame >= first_frame";
    return {
        {"sequence",
         std::string("width") + kPixels + " AND height" + kPixels + " AND frame_count" + frames + " AND frame_rate_hz" +
             kRate + " AND " + areShort("path"),
         "size, length or frame rate of a video is impossible"},
        {"run",  // without an end and without a frame yet it ends before its first one
         "first_frame" + frames + " AND last_frame BETWEEN -1 AND " + std::to_string(kLastFrame) +
             " AND gsd_m_per_px BETWEEN 1e-4 AND 1e4 AND frame_rate_hz" + kRate + " AND " +
             isOneOf("state", stored::kRunStates) + " AND " +
             areShort("name, started_utc, engine_version, preset, message"),
         "range, scale or state of a run is impossible"},
        {"run", fittingScaleOrigin(), "where the scale of a run comes from, or how sure it is, is impossible", 12},
        {"sequence", "rate_assumed IN (0, 1)", "whether the frame rate of a video is assumed is impossible", 19},
        {"run", "rate_assumed IN (0, 1)", "whether the frame rate of a run is assumed is impossible", 19},
        {"sequence", fittingVideoStart(), "when a video began is no time", 21},
        {"run", fittingScaleSlope(), "how the scale of a run changes over the picture is impossible", 14},
        {"run", fittingRunStart(), "when in its second a run began is impossible", 26},
        {"frame",
         frame + " AND width" + kPixels + " AND height" + kPixels + " AND corner_count >= 0 AND " +
             isOneOf("registration_state", stored::kRegistrationStates),
         "number, size or state of a frame is impossible"},
        {"frame",
         isOneOf("reason", stored::kRegistrationFaults) + " AND " + isOneOf("picture", stored::kPictureQualities),
         "why a frame was not registered is no reason that there is", 9},
        {"motion_vectors", frame + " AND are_motion_vectors(data)", "motion vectors of a frame cannot be read"},
        {"stationary_corners", frame + " AND are_points(data)", "corners of a frame cannot be read"},
        {"motion_cluster", frame + " AND are_indices(members)", "a cluster cannot be read"},
        {"roi", frame, "frame of a search area is impossible"},
        {"detection", frame + " AND are_indices(vectors) AND " + isOneOf("rejection", stored::kRejections),
         "a detection cannot be read"},
        {"detection", "(probability IS NULL OR probability BETWEEN 0 AND 1)",
         "probability of a detection is impossible", 16},
        {"track", range + " AND last_frame >= first_frame AND frames > 0", "life of a track is impossible"},
        {"track", "(score IS NULL OR score BETWEEN 0 AND 1)", "score of a track is impossible", 20},
        {"track_state",
         frame + " AND " + isOneOf("status", stored::kTrackStatuses) + " AND " +
             isOneOf("origin", stored::kStateOrigins),
         "state of a track is impossible"},
        {"unfinished_track_state",
         frame + " AND " + isOneOf("status", stored::kTrackStatuses) + " AND " +
             isOneOf("origin", stored::kStateOrigins),
         "state of a track is impossible"},
        {"frame", "elapsed BETWEEN 1 AND " + std::to_string(kLastFrame), "time of a frame is impossible", 29},
        {"frame", "zoom BETWEEN 1e-2 AND 1e2", "zoom of a frame is impossible", 29},
        {"frame", "details IN (0, 1)", "whether details of a frame were kept is no answer", 15},
        {"unfinished_frame", frame + " AND are_squeezed_vectors(vectors) AND are_squeezed_boxes(vehicles)",
         "what finishing needs of a frame cannot be read", 15},
        {"doubtful_state",
         frame + " AND " + isOneOf("status", stored::kTrackStatuses) + " AND " +
             isOneOf("origin", stored::kStateOrigins),
         "state of a doubtful track is impossible"},
        {"track_evidence",
         areNumbers("flow_px, flow_ratio") +
             " AND detected BETWEEN 0 AND 1 AND looked_alike BETWEEN 0 AND 1 AND life_s BETWEEN 0 AND 1e300 AND "
             "alignment BETWEEN -1.001 AND 1.001 AND score BETWEEN 0 AND 1",
         "what speaks for a track is impossible"},
        {"track_evidence", "(decision IS NULL OR decision BETWEEN -6 AND 12)",
         "how much a track looks like a vehicle is impossible", 24},
        {"run_state", frame, "state of a run is impossible"},
        {"dropped_state", frame + " AND " + isOneOf("reason", stored::kTrackDrops),
         "a state left out of a track is impossible"},
        {"light_finding",
         range + " AND last_frame >= first_frame AND heading_deg >= 0 AND heading_deg < 360 AND " +
             isOneOf("outcome", stored::kLightOutcomes) +
             " AND reach_m BETWEEN 0 AND 1e300 AND scatter_m BETWEEN 0 AND 1e300 AND vehicles BETWEEN 0 AND 2147483647"
             " AND agreement BETWEEN 0 AND 1 AND (darkening IS NULL OR darkening BETWEEN 0 AND 1)"
             " AND trimmed BETWEEN 0 AND 2147483647 AND dropped BETWEEN 0 AND 2147483647",
         "how shadows fall is impossible"},
        {"frame_shadow", frame + " AND heading_deg >= 0 AND heading_deg < 360 AND reach_px BETWEEN 0 AND 1e300",
         "how shadows fall in a frame is impossible"},
        {"box_trim",
         "what IN ('shadows', 'beams') AND along BETWEEN 0 AND 1 AND across BETWEEN 0 AND 1 AND taken BETWEEN 0 AND 1",
         "what was taken out of the boxes of a track is impossible"},
        {"labelled_object",
         "id BETWEEN 1 AND 2147483647 AND last_frame >= 0 AND are_keyframes(keyframes) AND length(keyframes) > 1 AND " +
             isOneOf("origin", stored::kObjectOrigins) + " AND " + areShort("class, notes"),
         "a labelled object cannot be read"},
        {"ignore_region",
         "id BETWEEN 1 AND 2147483647 AND are_corners(polygon) AND " + life + " AND " +
             isOneOf("anchor", stored::kRegionAnchors) + " AND " + areShort("notes"),
         "an ignore region cannot be read"},
        {"review_mark",
         life + " AND " + isOneOf("state", stored::kReviewStates) + " AND " + areShort("person, when_utc"),
         "a review mark is impossible"},
        {"object_class", areShort("name"), "name of a class is impossible"},
        {"rejected_proposal", areShort("person, when_utc"), "a rejected proposal cannot be read"},
        {"edit_journal", "undone IN (0, 1) AND " + areShort("name, made_utc"), "a step of work cannot be read"},
        {"verdict",
         "id BETWEEN 1 AND 2147483647 AND last_frame <= " + std::to_string(kLastFrame) + " AND " + life +
             " AND frame BETWEEN first_frame AND last_frame AND ground_frame" + frames + " AND " +
             areNumbers("first_s, last_s, x, y, ground_x, ground_y") + " AND " +
             isOneOf("kind", stored::kSubjectKinds) + " AND " + isOneOf("sense", stored::kCrossingSenses) + " AND " +
             isOneOf("judgement", stored::kJudgements) + " AND " + areShort("zone, note, tags, person, when_utc"),
         "a verdict cannot be read", 11},
        {"bookmark",
         "id BETWEEN 1 AND 2147483647 AND " + in_video + " AND " + areNumbers("seconds") +
             " AND (x IS NULL) = (y IS NULL) AND " + areShort("note, person, when_utc"),
         "a bookmark cannot be read", 11},
        {"control_point",
         in_video + " AND x BETWEEN -1e6 AND 1e6 AND y BETWEEN -1e6 AND 1e6 AND latitude_deg BETWEEN -90 AND 90 AND "
                    "longitude_deg BETWEEN -180 AND 180",
         "a control point is not on the earth", 15},
        {"zone",
         "id BETWEEN 1 AND 2147483647 AND " + in_video + " AND name <> '' AND colour BETWEEN -1 AND 16777215 AND " +
             "is_zone(shape, points) AND " + isOneOf("shape", stored::kZoneShapes) + " AND " +
             isOneOf("anchor", stored::kZoneAnchors) + " AND " + areShort("name, person, when_utc"),
         "a zone cannot be read"},
        {"zone",
         "(SELECT count(*) FROM zone AS other WHERE other.sequence_id = zone.sequence_id AND other.name = zone.name "
         "AND other.id < zone.id) = 0",
         "a zone has the name of another"},
        {"correction",
         "id BETWEEN 1 AND 2147483647 AND " + in_video + " AND " + isOneOf("kind", stored::kCorrectionKinds) +
             " AND is_correction(kind, frame, track, other) AND " + areShort("person, when_utc"),
         "a correction of tracks cannot be read", 17},
        {"review_step", "undone IN (0, 1) AND is_review_step(data) AND " + areShort("name, made_utc"),
         "a step of the review cannot be read", 11},
        {"seen", range + " AND last_frame >= first_frame AND " + areShort("person"), "what was watched is impossible",
         11},
        {"run_parameter", areShort("name, value"), "a parameter of a run cannot be read"},
        {"preset", areShort("name, saved_utc"), "a preset cannot be read"},
        {"preset_value", areShort("preset, name, value"), "a value of a preset cannot be read"},
        {"label_counter", "typeof(value) = 'integer' AND value >= 0", "a counter of the labels is impossible"},
        {"sweep", std::string("json_valid(plan) AND point_count") + frames, "plan of a sweep cannot be read"},
        {"sweep_point", "json_valid(figures) AND position >= 0", "figures of a sweep cannot be read"},
        {"comparison", "json_valid(report)", "a comparison cannot be read"},
    };
}

}  // namespace eyrie
