#pragma once

#include <QString>

#include "chain/live/live_run.h"
#include "widgets/theme_colours.h"

/// How a live source stands, for people.
namespace eyrie::ui {

/// How much a person has to worry about the source itself.
Signal signalOf(const LiveStatus& status);
/// "receiving, 0.4 s behind", "no picture for 4.0 s", "connection lost 12.0 s ago; trying again for 30.0 s".
/// `give_up_s`: after how long without a picture it is given up.
QString liveStateText(const LiveStatus& status, double give_up_s);
/// What was given up to keep pace: "keeps pace", "fewer corners now; 12 of 1,000 frames left out".
QString liveLoadText(const LiveStatus& status);
/// "12.3 MB recorded"; with little space: "12.3 MB recorded, only 500.0 MB left".
QString liveRecordingText(const LiveFacts& facts);
/// What is left on the disk, in a sentence; empty where nobody knows.
QString liveSpaceText(const LiveFacts& facts);
/// Whether the disk will soon be full.
bool isNearlyFull(const LiveFacts& facts);

}  // namespace eyrie::ui
