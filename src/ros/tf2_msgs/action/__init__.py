# Written by scripts/generate_messages.py from interfaces/tf2_msgs/action; do not edit.
"""Actions of tf2_msgs."""

from coframe.messages.events import event_attributes
from coframe.messages.generated.tf2_msgs.action import (
    LookupTransform,
    LookupTransform_Feedback,
    LookupTransform_FeedbackMessage,
    LookupTransform_GetResult,
    LookupTransform_GetResult_Request,
    LookupTransform_GetResult_Response,
    LookupTransform_Goal,
    LookupTransform_Result,
    LookupTransform_SendGoal,
    LookupTransform_SendGoal_Request,
    LookupTransform_SendGoal_Response,
)

__all__ = [
    "LookupTransform",
    "LookupTransform_Feedback",
    "LookupTransform_FeedbackMessage",
    "LookupTransform_GetResult",
    "LookupTransform_GetResult_Request",
    "LookupTransform_GetResult_Response",
    "LookupTransform_Goal",
    "LookupTransform_Result",
    "LookupTransform_SendGoal",
    "LookupTransform_SendGoal_Request",
    "LookupTransform_SendGoal_Response",
]

__getattr__ = event_attributes("tf2_msgs", "action")
