/// What the process answers its caller. Part of the interface: scripts rely on the numbers.
#pragma once

namespace gyrod::app {

enum ExitCode : int {
  kDone = 0,           ///< all of it was done
  kFailed = 1,         ///< something that no other code names, a defect of gyrod among them
  kWrongUsage = 2,     ///< the command line is wrong
  kWrongSettings = 3,  ///< the configuration file cannot be read or has errors
  kFileTrouble =
      4,  ///< a recording or calibration cannot be read or understood, or an output cannot be written
  kUnavailable = 5,  ///< DDS or the HTTP port refuses; top: no answer
  kIncomplete = 6,   ///< done, but data are missing: a gap, nobody there, a hurried stop, all samples refused
  kNotAllowed =
      7,  ///< a certificate, key, token or password file is no good, or DDS or HTTP permissions forbid it
  kTroubled = 8,       ///< top --once: gyrod is not ready, or a sensor is troubled
  kInterrupted = 130,  ///< Ctrl-C or SIGTERM ended it before it was done (128 + SIGINT, as shells count)
};

/// The codes in words, for the end of the help text.
inline constexpr const char* kExitCodesHelp =
    "Exit codes: 0 done; 1 failed; 2 wrong usage; 3 wrong configuration; 4 a file cannot be read,\n"
    "understood or written; 5 DDS or the HTTP port refuses, or nobody answers there; 6 done, but data are\n"
    "missing; 7 a certificate, key, token or password file is no good, or DDS or HTTP permissions forbid "
    "it;\n"
    "8 top --once: gyrod is not ready, or a sensor is troubled; 130 interrupted.";

}  // namespace gyrod::app
