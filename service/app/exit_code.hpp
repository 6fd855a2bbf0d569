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
  kUnavailable = 5,    ///< DDS or the HTTP port refuses
  kIncomplete = 6,     ///< done, but data are missing: a gap, nobody there, a stop that had to hurry
  kNotAllowed = 7,     ///< a certificate, key, token or password file is no good, or DDS permissions forbid it
  kInterrupted = 130,  ///< Ctrl-C or SIGTERM ended it before it was done (128 + SIGINT, as shells count)
};

/// The codes in words, for the end of the help text.
inline constexpr const char* kExitCodesHelp =
    "Exit codes: 0 done; 1 failed; 2 wrong usage; 3 wrong configuration; 4 a file cannot be read,\n"
    "understood or written; 5 DDS or the HTTP port refuses; 6 done, but data are missing;\n"
    "7 a certificate, key, token or password file is no good, or DDS permissions forbid it; 130 interrupted.";

}  // namespace gyrod::app
