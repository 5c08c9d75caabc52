"""The mechanism as hands that hold an object: contacts, partition, statics."""
