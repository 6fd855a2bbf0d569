/// How a program makes itself known.
#pragma once

namespace gyrod::bus {

/// How often a program says that it is there; others answer when they hear it.
enum class Calling {
  kUsual,  ///< as the network's configuration says; by default at the start, and then every 8 s
  kOften,  ///< four times a second, unless the network's configuration says otherwise: found within a second where many packets are lost.
           ///< On the loopback network as usual: nothing is lost there
};

}  // namespace gyrod::bus
