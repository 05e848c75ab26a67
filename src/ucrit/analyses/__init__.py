"""One file per question, by what it asks about. An analysis knows no vehicle; it states what it needs of a model."""
