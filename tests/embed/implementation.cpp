#define WIRESKIN_IMPLEMENTATION
#include "wireskin.h"
