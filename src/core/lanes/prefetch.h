// Software prefetch: prefetch(where) fetches the cache line of any address.
#pragma once

#include "core/lanes/native.h"
