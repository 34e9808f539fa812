#include "nord_driver/tools/transport_loader.h"

namespace nord_driver::tools {

boost::shared_ptr<Transport> TransportLoader::load(const std::string& name) {
  if (loader_.isClassAvailable(name)) return loader_.createInstance(name);
  std::string known;
  for (const std::string& declared : loader_.getDeclaredClasses()) known += (known.empty() ? "" : ", ") + declared;
  throw ConfigError("transport: \"" + name + "\" is not valid, expected one of the declared transports: " +
                    (known.empty() ? "none (is the workspace's setup file sourced?)" : known));
}

}  // namespace nord_driver::tools
