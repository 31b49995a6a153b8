#pragma once

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Statement.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/geometry/oriented_box.h"
#include "store/database/database_error.h"
#include "store/runs/packed_arrays.h"
#include "store/runs/stored_words.h"

/// Values into statements and out of them, column after column, so that no column number is ever written down.
namespace eyrie {

/// Binds the parameters of one row from the first to the last, then runs the statement. What is bound must live until
/// run().
class RowWriter {
 public:
    explicit RowWriter(SQLite::Statement& statement) : statement_(statement) {
        statement_.tryReset();  // may have failed the time before; that was reported then
    }
    RowWriter& integer(std::int64_t value) {
        statement_.bind(next_++, value);
        return *this;
    }
    RowWriter& real(double value) {
        statement_.bind(next_++, value);
        return *this;
    }
    RowWriter& text(const std::string& value) {
        statement_.bindNoCopy(next_++, value);
        return *this;
    }
    RowWriter& bytes(const Bytes& value) {
        statement_.bindNoCopy(next_++, value.data(), static_cast<int>(value.size()));
        return *this;
    }
    RowWriter& point(cv::Point2d value) { return real(value.x).real(value.y); }
    RowWriter& box(const OrientedBox& value) {
        return point(value.centre).real(value.length).real(value.width).real(value.heading);
    }
    template <class Enum, std::size_t count>
    RowWriter& word(const std::array<stored::Word<Enum>, count>& words, Enum value) {
        for (const auto& entry : words) {
            // The words are literals, so the terminating zero is there.
            if (entry.value == value) {
                statement_.bindNoCopy(next_++, entry.word.data());
                return *this;
            }
        }
        throw Error(ErrorKind::internal, "an enumerator has no word in the project file");
    }
    void run() {
        statement_.exec();
        statement_.tryReset();
    }

 private:
    SQLite::Statement& statement_;
    int next_ = 1;
};

/// Reads the columns of the present row from the first to the last. Throws MalformedRow for what no writer wrote.
class RowReader {
 public:
    explicit RowReader(SQLite::Statement& statement) : statement_(statement) {}

    std::int64_t wide() { return statement_.getColumn(next_++).getInt64(); }
    int integer() { return statement_.getColumn(next_++).getInt(); }
    double real();
    cv::Point2d point() {
        const double x = real();
        const double y = real();
        return {x, y};
    }
    OrientedBox box();
    /// A name, a path, a note: what people read. Throws MalformedRow when it is longer than any of them.
    std::string text();
    /// A document of ours.
    std::string longText() { return statement_.getColumn(next_++).getString(); }
    RegistrationFailure failure() {
        RegistrationFailure value;
        value.fault = word(stored::kRegistrationFaults);
        value.picture = word(stored::kPictureQualities);
        value.count = integer();
        value.of = integer();
        return value;
    }
    ByteView bytes() {
        const SQLite::Column column = statement_.getColumn(next_++);
        // The blob's address must be asked for before its size.
        const auto* data = static_cast<const std::byte*>(column.getBlob());
        return {data, static_cast<std::size_t>(column.getBytes())};
    }
    template <class Enum, std::size_t count>
    Enum word(const std::array<stored::Word<Enum>, count>& words) {
        // Not by text(): states of tracks have two words each, and are read by the thousand.
        const SQLite::Column column = statement_.getColumn(next_);
        const char* const begin = column.getText();
        const std::string_view found(begin, static_cast<std::size_t>(column.getBytes()));
        for (const auto& entry : words) {
            if (entry.word == found) {
                ++next_;
                return entry.value;
            }
        }
        throw MalformedRow{"unknown word \"" + text() + "\""};
    }
    /// The value of an unpacking, which must have succeeded.
    template <class Value>
    static Value unpacked(std::optional<Value> value, const char* what) {
        if (!value) throw MalformedRow{std::string("broken ") + what};
        return std::move(*value);
    }

 private:
    SQLite::Statement& statement_;
    int next_ = 0;
};

/// The columns that readTrackState() reads, in its order.
inline constexpr char kTrackStateColumns[] =
    "track_id, x, y, length, width, heading_rad, vx, vy, status, origin, age, hits, score";
TrackState readTrackState(RowReader& row);

}  // namespace eyrie
