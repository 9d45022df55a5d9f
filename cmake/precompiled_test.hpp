// The same for tests.
#include "precompiled.hpp"

#include <gtest/gtest.h>
