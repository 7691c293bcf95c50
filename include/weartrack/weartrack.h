/* weartrack - all public headers. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_WEARTRACK_H
#define WEARTRACK_WEARTRACK_H

#include "weartrack/case.h"
#include "weartrack/core.h"
#include "weartrack/dma.h"
#include "weartrack/friction.h"
#include "weartrack/indentation.h"
#include "weartrack/job.h"
#include "weartrack/layer.h"
#include "weartrack/read.h"
#include "weartrack/record.h"
#include "weartrack/report.h"
#include "weartrack/study.h"
#include "weartrack/surface.h"
#include "weartrack/view.h"

#endif
